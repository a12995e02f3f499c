#pragma once
#include <span>
#include <vector>

#include "core/element/contribution.hpp"
#include "core/element/packing.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline element {

/// Faces under a fluid's pressure: a×b = ∂x/∂ξ × ∂x/∂η points out of the fluid, into the solid. 2×2 Gauss
/// points.
/// Volume, volume gradient and linearisation of a fluid cavity (formulation, section 2.2):
///     V = ⅓ Σ ∫ (x − x0)·(a×b),   g_I = ∂V/∂x_I = Σ N_I (a×b),   force of the fluid on the solid: P g
/// Sums are over this rank's faces; nodal vectors have 3 numbers per local node and are added to.
class PressureSurface {
 public:
  /// `faces` have normals out of the solid, as a Mesh keeps them.
  explicit PressureSurface(std::span<const Quad> faces);

  bool empty() const { return count_ == 0; }
  /// Volume between the faces and the point x0.
  double volume(std::span<const double> x, const Point& x0) const;
  /// out += factor · g
  void add_gradient(std::span<const double> x, double factor, std::span<double> out) const;
  /// out += factor · (∂g/∂x) dx
  void add_stiffness(std::span<const double> x, double factor, std::span<const double> dx,
                     std::span<double> out) const;
  /// factor · ∂g/∂x, face by face. Unsymmetric per face; its sum over a closed surface is symmetric.
  void visit(std::span<const double> x, double factor, const ContributionVisitor& visitor) const;
  std::size_t bytes() const;

 private:
  std::vector<PackNodes<4>> packs_;
  int count_;
};

}  // namespace bulbus::inline element
