#include "precond/coarse/coarse_matrix.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {

void CoarseMatrix::clear() { blocks_.assign(places_.size(), Block{}); }

void CoarseMatrix::release() { std::vector<Block>().swap(blocks_); }

void CoarseMatrix::shrink() {
  blocks_.shrink_to_fit();
  places_.shrink_to_fit();
}

CoarseMatrix::Block& CoarseMatrix::block(int row, int column) {
  const auto [at, added] =
      at_.emplace((static_cast<long long>(row) << 32) + column, static_cast<int>(blocks_.size()));
  if (added) {
    blocks_.emplace_back();
    places_.push_back({row, column});
  }
  return blocks_[at->second];
}

void CoarseMatrix::find_parts(const Aggregates& groups, std::span<const NodeModes> modes,
                              std::span<const int> dofs) {
  const int nodal = 3 * static_cast<int>(groups.of.size());
  parts_.clear();
  for (std::size_t i = 0; i < dofs.size();) {
    const bool body = dofs[i] >= nodal;
    const int group = body ? (dofs[i] - nodal) / 6 : groups.of[dofs[i] / 3];
    if (group >= 0) parts_.push_back({group, static_cast<int>(i), body ? nullptr : &modes[dofs[i] / 3]});
    i += body ? 6 : 3;
  }
  std::ranges::stable_sort(parts_, {}, &Part::group);
}

void CoarseMatrix::multiply(std::span<const Part> columns, std::span<const double> K, std::size_t size) {
  half_.assign(size, {});
  for (const Part& p : columns)
    for (std::size_t r = 0; r < size; ++r) {
      const double* row = &K[r * size + p.first];
      if (!p.modes)
        for (int c = 0; c < 6; ++c) half_[r][c] += row[c];
      else
        for (int k = 0; k < 3; ++k)
          for (int c = 0; c < 8; ++c) half_[r][c] += row[k] * (*p.modes)[k][c];
    }
}

void CoarseMatrix::gather(const Part& row, int column) {
  Block& to = block(row.group, column);
  if (!row.modes)
    for (int i = 0; i < 6; ++i)
      for (int c = 0; c < 8; ++c) to[i][c] += half_[row.first + i][c];
  else
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 6; ++i)
        for (int c = 0; c < 8; ++c) to[i][c] += (*row.modes)[k][i] * half_[row.first + k][c];
}

void CoarseMatrix::add(const Aggregates& groups, std::span<const NodeModes> modes, std::span<const int> dofs,
                       std::span<const double> K) {
  find_parts(groups, modes, dofs);
  for (auto rest = std::span<const Part>(parts_); !rest.empty();) {
    const int column = rest.front().group;
    const auto end = std::ranges::find_if(rest, [&](const Part& p) { return p.group != column; });
    const auto columns = rest.first(end - rest.begin());
    rest = rest.subspan(columns.size());
    multiply(columns, K, dofs.size());
    for (const Part& row : parts_)
      if (!symmetric_ || row.group <= column) gather(row, column);
  }
}

Triplets CoarseMatrix::triplets() const {
  std::vector<int> order(blocks_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int k) { return places_[k]; });
  Triplets t;
  t.row.reserve(36 * blocks_.size()), t.col.reserve(36 * blocks_.size()),
      t.value.reserve(36 * blocks_.size());
  for (int k : order) {
    const auto [row, column] = places_[k];
    for (int i = 0; i < 6; ++i)
      for (int j = symmetric_ && row == column ? i : 0; j < 6; ++j) {
        t.row.push_back(6 * row + i);
        t.col.push_back(6 * column + j);
        t.value.push_back(blocks_[k][i][j]);
      }
  }
  return t;
}

void CoarseMatrix::visit(const BlockVisitor& visitor) const {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const auto [row, column] = places_[k];
    BlockMatrix::Block block, transposed;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const double value = symmetric_ && row == column && j < i ? blocks_[k][j][i] : blocks_[k][i][j];
        block[6 * i + j] = transposed[6 * j + i] = value;
      }
    visitor(row, column, block);
    if (symmetric_ && row != column) visitor(column, row, transposed);
  }
}

std::size_t CoarseMatrix::bytes() const { return bytes_of(blocks_) + bytes_of(places_) + at_.size() * 32; }

}  // namespace bulbus::inline precond
