#pragma once
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/schur/schur_correction.hpp"

namespace bulbus {

/// Approximate inverse of the element pressures' Schur complement Bᵀ A⁻¹ B:
///
///     Ŝ⁻¹ = (1 + γ) μ_e/V0_e + θ Σ corrections
///
/// The first part is right for pressures that strain the tissue. Checkerboard modes of pressure along a layer
/// hardly do: Q1/P0 leaves them almost free, and what holds them goes through the layer's thickness, so that
/// K, the Schur complement with the lines of the displacement block, knows of it and nodal blocks do not. The
/// corrections invert K by polynomials, as fixed linear maps, and leave smooth pressures alone. On refined
/// meshes K is that of lines with a tenth of the augmentation: lines carry it without the neighbours that
/// undo it in a checkerboard mode's displacement, and make K up to eleven times too soft. K's least
/// eigenvalues fall with the square of a hexahedron's size, but a refined mesh knows its checkerboard modes,
/// and the slow ones among them are few. Taken up when a solve drags, or at once.
class PressureSchur final : public Preconditioner {
 public:
  /// The corrections and what they are made of.
  struct Weak {
    std::unique_ptr<const LineJacobi> softened;  // these two where a part needs them
    std::unique_ptr<const LinePressureStiffness> K;
    std::vector<std::unique_ptr<SchurCorrection>> parts;
    std::size_t bytes() const;
  };
  /// `lines` may be null: then there is the first part only. `weak` may be an earlier linearisation's; it has
  /// to outlive this, and on meshes that are not refined `lines` have to outlive it.
  PressureSchur(const CoupledSystem& system, const LineJacobi* lines, const PressureSettings& settings,
                Weak& weak);
  bool has_deferred_component() const { return lines_ && !strong_; }
  /// Takes up the other parts, and makes them if they are not there. Collective.
  void enable_deferred_component();
  int size() const override { return static_cast<int>(diagonal_.size()); }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool fixed() const override { return true; }
  std::size_t bytes() const override;

 private:
  const CoupledSystem& system_;
  const LineJacobi* lines_;
  PressureSettings settings_;
  std::vector<double> diagonal_;
  Weak& weak_;
  bool strong_ = false;
};

}  // namespace bulbus
