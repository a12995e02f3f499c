#pragma once
#include <Eigen/Dense>
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_solver.hpp"
#include "precond/operators/displacement_preconditioner.hpp"
#include "precond/schur/pressure_schur.hpp"

namespace bulbus::inline precond {

/// Â⁻¹ g of every liquid with an unknown pressure, on primal vectors.
using LiquidColumns = std::vector<std::vector<double>>;

/// Block upper-triangular preconditioner of the bordered system, with a Schur complement of the element
/// pressures and one of the cavity pressures (formulation, section 9.2):
///
///     [ Â_ω   B    −(I − ωC) G ]        Ŝ: see PressureSchur
///     [ 0    −Ŝ     0          ]        S_c = C + Gᵀ Â_ω⁻¹ G (I − ωC),   C = V_i/K
///     [ 0     0    −S_c        ]
///
/// Â_ω = Â + Σ ω g gᵀ by Woodbury, from Z = Â⁻¹ G. It asks for ω = 1 / gᵀ Â⁻¹ g, the wall's own stiffness
/// against volume. Where pressures are eliminated ω is K/V_i, and the last column is empty.
class BlockTriangular final : public CoupledPreconditioner {
 public:
  /// `corrections` and `columns` may be those of an earlier linearisation; where they are empty they are
  /// made. Collective.
  BlockTriangular(SharedSystem system, std::shared_ptr<const DisplacementPreconditioner> displacement,
                  const PressureSettings& pressures, std::shared_ptr<SchurCorrections> corrections,
                  std::shared_ptr<LiquidColumns> columns);
  int size() const override { return system_->size(); }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool is_linear() const override { return displacement_->is_linear(); }
  std::string setup_error() const override { return displacement_->setup_error(); }
  /// The correction for oscillating element pressures.
  bool has_deferred_component() const override { return inverse_schur_.has_deferred_component(); }
  void enable_deferred_component(double tolerance) override {
    inverse_schur_.enable_deferred_component(tolerance);
  }
  const LiquidAugmentation& augmentation() const override { return augmentation_; }
  std::size_t bytes() const override;
  std::array<double, 2> displacement_spectrum() const override;

 private:
  std::vector<double> liquid_products(std::span<const double> primal) const;

  SharedSystem system_;
  std::shared_ptr<const DisplacementPreconditioner> displacement_;
  PressureSchur inverse_schur_;
  LiquidAugmentation augmentation_;
  std::shared_ptr<const LiquidColumns> Z_;
  std::vector<int> coupled_;    // liquids with an unknown pressure
  std::vector<double> column_;  // of every liquid: what its column keeps of −g
  Eigen::MatrixXd woodbury_;    // (Ω⁻¹ + GᵀZ)⁻¹
  Eigen::MatrixXd inverse_liquid_schur_;
  mutable std::vector<double> work_;
};

}  // namespace bulbus::inline precond
