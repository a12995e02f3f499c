#pragma once
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/schur/schur_correction.hpp"

namespace bulbus::inline precond {

/// The corrections of PressureSchur and what they are made of; empty until they are taken up.
struct SchurCorrections {
  std::shared_ptr<const LineJacobi> reduced;  ///< these two where a correction needs them
  std::shared_ptr<LinePressureStiffness> K;
  std::vector<std::unique_ptr<SchurCorrection>> parts;
  bool for_many_digits = false;  ///< see oscillation_correction
  /// See LinePressureStiffness.
  void refresh(const SharedSystem& system);
  void release();
  std::size_t bytes() const;
};

/// Approximate inverse of the element pressures' Schur complement Bᵀ A⁻¹ B, with the inf-sup correction for
/// Q1/P0 (formulation, section 9.5):
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
/// and the slow ones among them are few. Taken up when a solve is slow, or at once.
class PressureSchur final : public Preconditioner {
 public:
  /// `lines` may be null: then there is the first part only. `corrections` are made when they are first taken
  /// up, unless they are there, of an earlier linearisation.
  PressureSchur(SharedSystem system, std::shared_ptr<const LineJacobi> lines,
                const PressureSettings& settings, std::shared_ptr<SchurCorrections> corrections);
  bool has_deferred_component() const { return lines_ && !corrected_; }
  /// Takes up the other parts, and makes them if they are not there, or not for as many digits as this
  /// relative tolerance of a solve asks for. Collective.
  void enable_deferred_component(double tolerance);
  int size() const override { return static_cast<int>(diagonal_.size()); }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override;

 private:
  SharedSystem system_;
  std::shared_ptr<const LineJacobi> lines_;
  PressureSettings settings_;
  std::vector<double> diagonal_;
  std::shared_ptr<SchurCorrections> corrections_;
  bool corrected_ = false;
};

}  // namespace bulbus::inline precond
