#include "precond/schur/checkerboard_modes.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {
namespace {

// Of a child on the lower or upper side of its parent in direction d; child c has corner c.
float side(int child, int d) {
  constexpr int upper[3] = {0b01100110, 0b11001100, 0b11110000};
  return upper[d] >> child & 1 ? -1 : 1;
}

// f(k) of four: 1, the signs of parents, those of parents and children; the signs of children make xyz, the
// same in all directions.
CheckerboardModes::Row row(int part, int refinements) {
  const int child = part & 7, parent = part >> 3;
  CheckerboardModes::Row r(refinements > 1 ? 10 : 4);
  r[0] = side(child, 0) * side(child, 1) * side(child, 2);
  for (int z = 0, k = 1; z < 3; ++z) {
    const float board = side(child, (z + 1) % 3) * side(child, (z + 2) % 3);
    r[k++] = board;
    if (refinements == 1) continue;
    r[k++] = board * side(parent, z);
    r[k++] = board * side(parent, z) * side(child, z);
  }
  return r;
}

}  // namespace

CheckerboardModes::CheckerboardModes(const Problem& problem, int refinements) {
  const LocalMesh& mesh = problem.mesh();
  const int shift = 3 * refinements, hexes = static_cast<int>(mesh.hexes.size());
  for (int part = 0; part < 1 << shift; ++part) rows_.push_back(bulbus::row(part, refinements));
  std::vector<bool> rigid(hexes);
  for (int h : problem.solid().rigid_hexes()) rigid[h] = true;
  for (int h = 0; h < hexes; ++h)
    if (!rigid[h]) label_.push_back(mesh.input_hex[h] >> shift);
  std::ranges::sort(label_);
  label_.erase(std::unique(label_.begin(), label_.end()), label_.end());
  label_.shrink_to_fit();
  of_.reserve(hexes);
  part_.reserve(hexes);
  for (int h = 0; h < hexes; ++h) {
    of_.push_back(rigid[h] ? -1
                           : static_cast<int>(std::ranges::lower_bound(label_, mesh.input_hex[h] >> shift) -
                                              label_.begin()));
    part_.push_back(mesh.input_hex[h] & ((1 << shift) - 1));
  }
}

void CheckerboardModes::restrict_pressures(std::span<const double> p, std::span<double> c) const {
  std::ranges::fill(c, 0.0);
  const int n = count();
  for (std::size_t h = 0; h < of_.size(); ++h)
    if (of_[h] >= 0)
      for (int k = 0; k < n; ++k) c[n * of_[h] + k] += rows_[part_[h]][k] * p[h];
}

void CheckerboardModes::add_prolonged(std::span<const double> c, double weight, std::span<double> p) const {
  const int n = count();
  for (std::size_t h = 0; h < of_.size(); ++h)
    if (of_[h] >= 0)
      for (int k = 0; k < n; ++k) p[h] += weight * rows_[part_[h]][k] * c[n * of_[h] + k];
}

std::size_t CheckerboardModes::bytes() const { return bytes_of(label_) + bytes_of(of_) + bytes_of(part_); }

}  // namespace bulbus::inline precond
