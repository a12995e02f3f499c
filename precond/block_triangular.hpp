#pragma once
#include <Eigen/Dense>
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_solver.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/schur/pressure_schur.hpp"

namespace bulbus {

/// Block upper-triangular preconditioner of the bordered system:
///
///     [ Â_ω   B    −(I − ωC) G ]        Ŝ: see PressureSchur
///     [ 0    −Ŝ     0          ]        S_c = C + Gᵀ Â_ω⁻¹ G (I − ωC),   C = V_i/K
///     [ 0     0    −S_c        ]
///
/// Â_ω = Â + Σ ω g gᵀ by Woodbury, from Z = Â⁻¹ G. Sets the system's ω to 1 / gᵀ Â⁻¹ g: the wall's own
/// stiffness against volume; to K/V_i where pressures are eliminated, where the last column is empty.
class BlockTriangular final : public CoupledPreconditioner {
 public:
  /// What may be an earlier linearisation's.
  struct Parts {
    std::vector<std::vector<double>> Z;
    PressureSchur::Weak weak;
  };
  /// Makes what `parts`, which have to outlive it, lack. Collective.
  BlockTriangular(CoupledSystem& system, const DisplacementInverse& displacement,
                  const PressureSettings& pressures, Parts& parts);
  int size() const override { return system_.size(); }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool fixed() const override { return displacement_->fixed(); }
  std::string fault() const override { return displacement_->fault(); }
  /// The pressures' weak patterns.
  bool has_deferred_component() const override { return inverse_schur_.has_deferred_component(); }
  void enable_deferred_component() override { inverse_schur_.enable_deferred_component(); }
  std::size_t bytes() const override;
  std::array<double, 2> displacement_spectrum() const override;

 private:
  std::vector<double> liquid_products(std::span<const double> primal) const;

  CoupledSystem& system_;
  std::shared_ptr<const Preconditioner> displacement_;
  PressureSchur inverse_schur_;
  const std::vector<std::vector<double>>& Z_;
  std::vector<int> coupled_;  // liquids with an unknown pressure
  Eigen::MatrixXd woodbury_;  // (Ω⁻¹ + GᵀZ)⁻¹
  Eigen::MatrixXd inverse_liquid_schur_;
  mutable std::vector<double> work_;
};

}  // namespace bulbus
