#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/memory.hpp"
#include "core/element/contribution.hpp"
#include "core/element/mean_tangent.hpp"
#include "core/element/packing.hpp"
#include "core/material/material.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline element {

/// A run of hexahedra of one material.
struct SolidRegion {
  std::string name;
  Material material;
  int first = 0, count = 0;  ///< hexahedra
  int first_pack = 0, packs = 0;
};

/// How the tangent gets the strain at its Gauss points.
enum class StrainSource { recompute, cache };

/// Stress of one hexahedron: the mean over its Gauss points.
struct CellStress {
  Sym3<double> cauchy;  ///< MPa
  double mises;         ///< MPa; mean of the points' Mises stresses
};

/// Total-Lagrangian Q1/P0 mixed hexahedra of one rank: nodal vectors have 3 numbers per local node (owned and
/// ghost), element vectors one per hexahedron. Forces are added, so that ghosts can be accumulated on their
/// owners afterwards.
///     R_u = Σ ∫ (τ + λJ I) : ∇ₓN dV0,   R_λ = V_e − V0_e
class Solid {
 public:
  /// `X`: reference places. The hexahedra of a region are consecutive; those of no region are rigid: they
  /// have a volume, but neither forces nor a volume equation.
  Solid(std::vector<double> X, std::span<const Hex> hexes, std::vector<SolidRegion> regions);

  int hexes() const { return static_cast<int>(V0_.size()); }
  const std::vector<SolidRegion>& regions() const { return regions_; }
  std::span<const double> reference_volumes() const { return V0_; }
  /// Hexahedra of no region.
  std::span<const int> rigid_hexes() const { return rigid_; }

  /// force += internal forces; volume_defect = V_e − V0_e.
  /// With `reference_force`: += |nodal force of each element|, the reference norm of the force balance.
  void residual(std::span<const double> x, std::span<const double> lambda, std::span<double> force,
                std::span<double> volume_defect, std::span<double> reference_force = {}) const;

  /// Smallest J of any Gauss point (+∞ without hexahedra), and its hexahedron.
  double least_jacobian(std::span<const double> x, int* hex = nullptr) const;
  /// The same of every hexahedron; a NaN counts as −∞. Those of no region have 1.
  std::vector<double> least_jacobians(std::span<const double> x) const;

  /// Fixes the state of the tangent; x and lambda must stay where they are until the next call.
  /// `gamma` augments: penalty_e = γ μ_e / V0_e with the current μ_e = 2 (W1 + W2), floored at a tenth of the
  /// initial one.
  void linearize(std::span<const double> x, std::span<const double> lambda, double gamma,
                 StrainSource source);

  /// force += (K + γ b W bᵀ) dx + b dlambda; volume_change = bᵀ dx. An empty dlambda counts as zero, an empty
  /// volume_change is not written.
  void apply(std::span<const double> dx, std::span<const double> dlambda, std::span<double> force,
             std::span<double> volume_change) const;
  /// force += (K + γ b W bᵀ) dx in single precision and with the mean of K over every hexahedron (see
  /// MeanTangent): for smoothers. A node each; a translation on top of the strain costs floats accuracy.
  void apply_single(std::span<const NodeSingle> dx, std::span<NodeSingle> force) const;
  /// force += b dlambda and volume_change = bᵀ dx in single precision.
  void apply_pressure_single(std::span<const double> dlambda, std::span<NodeSingle> force) const;
  void volume_change_single(std::span<const NodeSingle> dx, std::span<double> volume_change) const;
  /// volume_change = bᵀ dx.
  void volume_change(std::span<const double> dx, std::span<double> volume_change) const;
  /// force += b dlambda.
  void apply_pressure(std::span<const double> dlambda, std::span<double> force) const;

  /// Current shear modulus per hexahedron (MPa), floored, as of linearize().
  std::span<const double> shear_moduli() const { return mu_; }
  /// γ μ_e / V0_e per hexahedron.
  std::span<const double> penalties() const { return penalty_; }

  /// Element matrices of the linearised state, augmentation included where `augmented`.
  void visit(const ContributionVisitor& visitor, bool augmented) const;
  /// The matrices that apply_single() stands for, with this part of the augmentation, in a fifth of the time.
  void visit_mean(const ContributionVisitor& visitor, double augmentation = 1) const;
  /// b_e = ∂V_e/∂u of every hexahedron: 8 local nodes, 24 numbers.
  void visit_constraints(
      const std::function<void(int hex, std::span<const int> nodes, std::span<const double> b)>&) const;

  std::vector<CellStress> stresses(std::span<const double> x, std::span<const double> lambda) const;
  /// ∫ W dV0 of this rank.
  double energy(std::span<const double> x) const;

  std::size_t bytes() const;
  std::size_t cache_bytes() const;

 private:
  // body(material, pack number, first hexahedron)
  template <class Body>
  void for_each_pack(Body body) const {
    for (const SolidRegion& r : regions_)
      std::visit(
          [&](const auto& material) {
            for (int p = 0; p < r.packs; ++p) body(material, r.first_pack + p, r.first + p * lanes);
          },
          r.material);
  }
  template <class Use>
  void for_each_least_jacobian(std::span<const double> x, Use use) const;
  void update_moduli();
  void fill_cache();
  void round_places() const;
  void fill_tangents() const;
  template <class Body>
  void for_each_pair(Body body) const;

  std::vector<double> X_;
  std::vector<SolidRegion> regions_;
  std::vector<PackNodes<8>> packs_;
  std::vector<double> V0_, mu_, penalty_;
  std::vector<int> rigid_;
  std::vector<float, LargePages<float>> cache_;
  std::span<const double> x_, lambda_;
  struct Single {  // of the linearised state, empty until it is asked for
    std::vector<NodeSingle> x;
    std::vector<SingleTangent, LargePages<SingleTangent>> tangents;
  };
  mutable Single single_;
  double gamma_ = 0;
  StrainSource source_ = StrainSource::recompute;
};

}  // namespace bulbus::inline element
