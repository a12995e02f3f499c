#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/element/packing.hpp"
#include "core/material/material.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline element {

/// A run of hexahedra of one material.
struct SolidRegion {
  std::string name;
  Material material;
  int first = 0, count = 0;  ///< hexahedra
  /// Of a law with fibres: unit vectors in the reference configuration, 3 numbers of each family of each
  /// hexahedron.
  std::vector<double> directions = {};
  int first_pack = 0, packs = 0, first_fibre = 0;
};

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
  /// `X`: reference positions. The hexahedra of a region are consecutive; those of no region are rigid: they
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

  std::vector<CellStress> stresses(std::span<const double> x, std::span<const double> lambda) const;
  /// ∫ W dV0 of this rank.
  double energy(std::span<const double> x) const;

  std::size_t bytes() const;

 private:
  friend class SolidTangent;
  // The law of a region's pack p.
  template <class Law>
  const Law& on_pack(const Law& material, const SolidRegion&, int) const {
    return material;
  }
  FibreLaw<Pack> on_pack(const FibreReinforced& material, const SolidRegion& r, int p) const {
    return {material, fibres_.data() + r.first_fibre + p * material.families};
  }
  // body(material, pack number, first hexahedron)
  template <class Body>
  void for_each_pack(Body body) const {
    for (const SolidRegion& r : regions_)
      std::visit(
          [&](const auto& material) {
            for (int p = 0; p < r.packs; ++p)
              body(on_pack(material, r, p), r.first_pack + p, r.first + p * lanes);
          },
          r.material);
  }
  template <class Use>
  void for_each_least_jacobian(std::span<const double> x, Use use) const;
  void pack_fibres(SolidRegion& r);

  std::vector<double> X_;
  std::vector<SolidRegion> regions_;
  std::vector<PackNodes<8>> packs_;
  std::vector<Vec3<Pack>> fibres_;  // of each pack of a region with fibres: a direction per family
  std::vector<double> V0_;
  std::vector<int> rigid_;
};

}  // namespace bulbus::inline element
