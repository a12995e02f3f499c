#include "precond/coarse/aggregate_blocks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "precond/coarse/grow_aggregates.hpp"

namespace bulbus::inline precond {
namespace {

using Square = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Block = BlockMatrix::Block;

Eigen::Map<const Square> matrix(const Block& block) { return Eigen::Map<const Square>(block.data()); }

int number_of(const std::vector<int>& group) { return group.empty() ? 0 : std::ranges::max(group) + 1; }

// By Frobenius' norm.
std::vector<std::vector<int>> strong_neighbours(const BlockMatrix& A) {
  std::vector<double> diagonal(A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = 0; const int j : A.columns(i))
      if (const int at = k++; j == i) diagonal[i] = matrix(A.block(i, at)).norm();
  std::vector<std::vector<int>> strong(A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = 0; const int j : A.columns(i))
      if (const int at = k++; j != i && j < A.rows())
        if (matrix(A.block(i, at)).norm() > strong_coupling * std::sqrt(diagonal[i] * diagonal[j]))
          strong[i].push_back(j);
  return strong;
}

// The plain modes of `coarse` (columns) in terms of those of `fine`, which it contains:
// e × (x − C)/R = (r/R) e × (x − c)/r + e × (c − C)/R.
Square transfer(const RigidFrame& coarse, const RigidFrame& fine) {
  Vec3<double> d;
  for (int c = 0; c < 3; ++c) d[c] = (fine.center[c] - coarse.center[c]) * coarse.inverse_radius;
  Square T = Square::Identity();
  T.bottomRightCorner<3, 3>() *= coarse.inverse_radius / fine.inverse_radius;
  T.topRightCorner<3, 3>() << 0, d[2], -d[1], -d[2], 0, d[0], d[1], -d[0], 0;
  return T;
}

std::vector<RigidFrame> enclosing(const std::vector<RigidFrame>& frames, const std::vector<int>& group,
                                  int bodies) {
  std::vector<RigidFrame> all(number_of(group));
  std::vector<double> members(all.size()), radius(all.size());
  for (std::size_t i = bodies; i < frames.size(); ++i) {
    for (int c = 0; c < 3; ++c) all[group[i]].center[c] += frames[i].center[c];
    ++members[group[i]];
  }
  for (std::size_t g = bodies; g < all.size(); ++g)
    for (double& c : all[g].center) c /= members[g];
  for (std::size_t i = bodies; i < frames.size(); ++i)
    for (int c = 0; c < 3; ++c)
      radius[group[i]] = std::max(radius[group[i]], std::abs(frames[i].center[c] - all[group[i]].center[c]) +
                                                        1 / frames[i].inverse_radius);
  for (std::size_t g = bodies; g < all.size(); ++g) all[g].inverse_radius = 1 / radius[g];
  return all;
}

// Aggregates in the numbering of all ranks and weights of every row, ghosts included.
std::pair<std::vector<long long>, std::vector<Block>> with_ghosts(const Comm& comm, const BlockRows& rows,
                                                                  const std::vector<int>& group,
                                                                  const CoarserModes& modes) {
  const long long first = comm.offset(static_cast<long long>(modes.frames.size()));
  std::vector<double> numbers(rows.size()), flat(36 * rows.size());
  for (int i = 0; i < rows.mine; ++i) {
    numbers[i] = static_cast<double>(first + group[i]);
    std::ranges::copy(modes.weights[i], flat.begin() + 36 * i);
  }
  rows.halo.update_ghosts(numbers, 1);
  rows.halo.update_ghosts(flat, 36);
  std::vector<Block> weights(rows.size());
  for (int i = 0; i < rows.size(); ++i) std::copy_n(flat.begin() + 36 * i, 36, weights[i].begin());
  return {{numbers.begin(), numbers.end()}, std::move(weights)};
}

}  // namespace

std::vector<int> aggregate_blocks(const BlockMatrix& A, int bodies, int size) {
  std::vector<char> excluded(A.rows());
  std::fill_n(excluded.begin(), bodies, 1);
  auto group = grow_aggregates(strong_neighbours(A), size, excluded);
  for (int i = 0; i < A.rows(); ++i) group[i] = i < bodies ? i : bodies + group[i];
  return group;
}

CoarserModes coarser_modes(const std::vector<RigidFrame>& frames, const std::vector<int>& group, int bodies) {
  CoarserModes m{enclosing(frames, group, bodies), std::vector<Block>(frames.size()), {}};
  std::vector<Square> gram(m.frames.size(), Square::Zero()), basis(m.frames.size(), Square::Identity());
  std::vector<Square> plain(frames.size(), Square::Identity());
  for (std::size_t i = bodies; i < frames.size(); ++i) {
    plain[i] = matrix(frames[i].coordinates) * transfer(m.frames[group[i]], frames[i]);
    gram[group[i]].noalias() += plain[i].transpose() * plain[i];
  }
  for (std::size_t g = bodies; g < gram.size(); ++g) {
    Block of;
    Eigen::Map<Square>(of.data()) = gram[g];
    const Block columns = orthonormal_basis(of);
    basis[g] = matrix(columns);
    Eigen::Map<Square>(m.frames[g].coordinates.data()) = basis[g].transpose() * gram[g];
    for (int k = 0; k < 6; ++k)
      if (basis[g].col(k).isZero(0)) m.missing.push_back(6 * static_cast<int>(g) + k);
  }
  for (std::size_t i = 0; i < frames.size(); ++i)
    Eigen::Map<Square>(m.weights[i].data()) = plain[i] * basis[group[i]];
  return m;
}

DistributedBlocks galerkin_product(const Comm& comm, const DistributedBlocks& fine,
                                   const std::vector<int>& group, const CoarserModes& modes,
                                   double missing_diagonal) {
  const auto& [rows, A] = fine;
  const int groups = static_cast<int>(modes.frames.size());
  const auto [number, weights] = with_ghosts(comm, rows, group, modes);
  std::vector<std::vector<int>> members(groups);
  for (int i = 0; i < rows.mine; ++i) members[group[i]].push_back(i);
  const long long first = comm.offset(static_cast<long long>(groups));
  std::vector<std::pair<std::array<long long, 2>, Block>> blocks;
  auto missing = modes.missing.begin();
  for (int g = 0; g < groups; ++g) {
    std::map<long long, Square> row{{first + g, Square::Zero()}};
    for (int i : members[g])
      for (int k = 0; const int j : A.columns(i))
        row.try_emplace(number[j], Square::Zero()).first->second.noalias() +=
            matrix(weights[i]).transpose() * (matrix(A.block(i, k++)) * matrix(weights[j]));
    for (; missing != modes.missing.end() && *missing < 6 * (g + 1); ++missing)
      row[first + g](*missing % 6, *missing % 6) += missing_diagonal;
    for (const auto& [column, sum] : row) {
      blocks.push_back({{first + g, column}, {}});
      Eigen::Map<Square>(blocks.back().second.data()) = sum;
    }
  }
  return assemble_blocks(comm, groups, [&](const BlockVisitor& visit) {
    for (const auto& [place, block] : blocks) visit(place[0], place[1], block);
  });
}

}  // namespace bulbus::inline precond
