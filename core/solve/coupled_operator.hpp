#pragma once
#include "core/solve/coupled_system.hpp"

namespace bulbus::inline solve {

/// ω of every liquid: how much of its row is added to the rows of the displacements. Chosen by who knows
/// gᵀ A⁻¹ g; empty: none.
struct LiquidAugmentation {
  std::vector<double> omega;  ///< MPa/mm³, the same on every rank
};

/// The bordered, augmented tangent in one state (docs/formulation.md, section 3), applied without being
/// formed:
///
///     [ K + γ B W Bᵀ + Σ ω g gᵀ     B    −(1 − ω V_i/K) g ]
///     [ Bᵀ                          0     0               ]
///     [ −gᵀ                         0    −V_i/K           ]
///
/// on free directions; constrained ones are identity rows times constrained_diagonal(). ω multiplies the
/// third row into the first: the liquids are augmented as the elements are, so that the displacement block
/// stays regular where K at fixed pressure is not. Eliminated formulation: ω = K/V_i, so that P leaves the
/// first row. It leaves the third too, whose unknown is then ΔP + (K/V_i) gᵀ Δu: a congruent system with the
/// same inertia, whose dense block (K/V_i) g gᵀ is what bordering saves. A liquid whose pressure is given
/// keeps its row −V/K and has no g; a hexahedron of a rigid region has a row of the same kind.
class CoupledOperator final : public LinearOperator {
 public:
  /// Where pressures are eliminated ω is K/V_i, whatever `augmentation` says.
  explicit CoupledOperator(SharedSystem system, const LiquidAugmentation& augmentation = {});

  const CoupledSystem& system() const { return *system_; }
  int size() const override { return system_->layout().size(); }
  void apply(std::span<const double> x, std::span<double> y) const override;
  /// −residual − tangent · ū, for prescribed increments ū still to be made (3 per local node), with the
  /// augmentation's part. Collective.
  std::vector<double> right_hand_side(const Residual& r, std::span<const double> prescribed) const;
  /// ΔP of every liquid, on every rank, from a solution of the system. Collective.
  std::vector<double> pressure_increments(std::span<const double> solution) const;

  /// ω of every liquid.
  std::span<const double> omega() const { return omega_; }
  /// What a liquid's column and row keep of −g: 1 − ω V_i/K and 1, or nothing.
  double column_part(int liquid) const;
  double row_part() const { return system_->eliminated() ? 0 : 1; }

 private:
  SharedSystem system_;
  std::vector<double> omega_;
};

/// The liquids' entries of an unknown vector, on every rank. Collective.
std::vector<double> shared_pressures(const CoupledSystem& system, std::span<const double> x);

/// ‖s v‖ over all ranks with the system's scaling s: the one norm of tolerances, free of units. Collective.
double scaled_norm(const CoupledSystem& system, std::span<const double> v);

}  // namespace bulbus::inline solve
