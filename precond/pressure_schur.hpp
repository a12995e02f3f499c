#pragma once
#include <array>
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/chebyshev.hpp"
#include "precond/line_jacobi.hpp"

namespace bulbus {

/// K = Bᵀ L⁻¹ B on element pressures, one number per hexahedron of this rank; L: the displacement block's parts on lines, with rigid
/// bodies at rest. B is stored in single precision, so that a motion of a whole hexahedron still does not change its volume.
class LinePressureStiffness final : public LinearOperator {
 public:
  LinePressureStiffness(const CoupledSystem& system, const LineJacobi& lines);
  int size() const override { return static_cast<int>(b_.size()); }
  /// Collective.
  void apply(std::span<const double> p, std::span<double> q) const override;
  std::size_t bytes() const;

 private:
  // x y z of a node and nothing
  using Four = double __attribute__((vector_size(32)));
  using FourSingle = float __attribute__((vector_size(16)));
  std::span<double> numbers() const { return {reinterpret_cast<double*>(nodal_.data()), 4 * nodal_.size()}; }

  const LocalMesh& mesh_;
  const LineJacobi& lines_;
  std::vector<std::array<FourSingle, 7>> b_;  // of nodes 1 to 7; that of node 0 is minus their sum
  std::vector<std::pair<int, Mat3<double>>> held_;  // owned nodes and their projectors
  mutable std::vector<Four> nodal_;
};

/// Approximate inverse of the element pressures' Schur complement Bᵀ A⁻¹ B:
///
///     Ŝ⁻¹ = (1 + γ) μ_e/V_e + θ q(K)
///
/// The first part is right for pressures that strain the tissue. Chessboards of pressure along a layer hardly do: Q1/P0 leaves them
/// almost free, and what holds them goes through the layer's thickness, so that the lines of the displacement block know of it and
/// nodal blocks do not. q is a Chebyshev polynomial that inverts K on nearly all of its spectrum: a fixed linear map, taken up when
/// a solve drags. K's least eigenvalues fall with the square of a hexahedron's size, and so does the part that q leaves out.
class PressureSchur final : public Preconditioner {
 public:
  /// `lines` may be null: then there is the first part only.
  PressureSchur(const CoupledSystem& system, const LineJacobi* lines, const PressureSettings& settings);
  bool holds_back() const { return lines_ && !weak_; }
  /// Takes up the second part, of the present linearisation. Collective.
  void strengthen();
  int size() const override { return static_cast<int>(diagonal_.size()); }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool fixed() const override { return true; }
  std::size_t bytes() const override;

 private:
  struct Weak;
  const CoupledSystem& system_;
  const LineJacobi* lines_;
  PressureSettings settings_;
  std::vector<double> diagonal_;
  std::shared_ptr<Weak> weak_;
  mutable std::vector<double> correction_;
};

}  // namespace bulbus
