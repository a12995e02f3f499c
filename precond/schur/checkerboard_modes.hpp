#pragma once
#include <Eigen/Dense>
#include <span>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline precond {

/// Checkerboard modes of the hexahedra that one of a coarser mesh was split into, in its own directions x, y,
/// z: (−1)^(i+j) f(k), and the same of yz and zx. Whatever f is, Q1/P0 hardly feels them. There are 3m − 2 of
/// m³ hexahedra: xy, yz, zx and xyz of a mesh refined once, ten of one refined twice. A vector on modes
/// has them one coarser hexahedron after the other; P takes it to element pressures.
class CheckerboardModes {
 public:
  static constexpr int most = 10;
  using Row = Eigen::Matrix<float, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most>;

  /// Of hexahedra refined so often (1 or 2) before.
  CheckerboardModes(const Problem& problem, int refinements);
  int count() const { return static_cast<int>(rows_.front().size()); }
  /// Coarser hexahedra of this rank.
  int coarser() const { return static_cast<int>(label_.size()); }
  int size() const { return count() * coarser(); }
  /// Indices in the coarser mesh, ascending.
  const std::vector<int>& labels() const { return label_; }
  /// Place of the coarser one among labels(); −1 of rigid hexahedra, which have no modes.
  int coarser_of(int hex) const { return of_[hex]; }
  /// A row of P: ±1 in every pattern of the coarser hexahedron.
  const Row& row(int hex) const { return rows_[part_[hex]]; }
  /// c = Pᵀ p
  void restrict_pressures(std::span<const double> p, std::span<double> c) const;
  /// p += weight P c
  void add_prolonged(std::span<const double> c, double weight, std::span<double> p) const;
  std::size_t bytes() const;

 private:
  std::vector<Row> rows_;
  std::vector<int> label_, of_;
  std::vector<unsigned char> part_;  // which part of the coarser hexahedron
};

}  // namespace bulbus::inline precond
