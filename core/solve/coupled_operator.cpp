#include "core/solve/coupled_operator.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/inner_product.hpp"

namespace bulbus::inline solve {

std::vector<double> shared_pressures(const CoupledSystem& system, std::span<const double> x) {
  std::vector<double> P(system.liquid_columns().size());
  if (system.layout().liquids > 0) std::ranges::copy(system.layout().pressures(x), P.begin());
  system.problem().comm().broadcast(P);
  return P;
}

CoupledOperator::CoupledOperator(SharedSystem system, const LiquidAugmentation& augmentation)
    : system_(std::move(system)), omega_(augmentation.omega) {
  omega_.resize(system_->liquid_columns().size());
  if (!system_->eliminated()) return;
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const int liquid = static_cast<int>(i);
    omega_[i] = system_->problem().liquids()[i].enclosed() ? 1 / system_->compliance(liquid) : 0;
  }
}

double CoupledOperator::column_part(int liquid) const {
  return system_->eliminated() ? 0 : 1 - omega_[liquid] * system_->compliance(liquid);
}

void CoupledOperator::apply(std::span<const double> x, std::span<double> y) const {
  const Layout& layout = system_->layout();
  const auto xu = layout.primal(x);
  const auto yu = layout.primal(y);
  system_->apply_tissue(xu, layout.lambda(x), yu, layout.lambda(y));
  const int liquids = static_cast<int>(omega_.size());
  if (liquids == 0) return;
  const auto dP = shared_pressures(*system_, x);
  const auto flux = system_->liquid_fluxes(xu);
  for (int i = 0; i < liquids; ++i) {
    add_scaled(system_->liquid_columns()[i], omega_[i] * flux[i] - column_part(i) * dP[i], yu);
    if (layout.liquids > 0) layout.pressures(y)[i] = -row_part() * flux[i] - system_->compliance(i) * dP[i];
  }
}

std::vector<double> CoupledOperator::pressure_increments(std::span<const double> solution) const {
  auto dP = shared_pressures(*system_, solution);
  if (!system_->eliminated()) return dP;
  const auto flux = system_->liquid_fluxes(system_->layout().primal(solution));
  for (std::size_t i = 0; i < dP.size(); ++i) dP[i] -= omega_[i] * flux[i];
  return dP;
}

std::vector<double> CoupledOperator::right_hand_side(const Residual& r,
                                                     std::span<const double> prescribed) const {
  const Problem& problem = system_->problem();
  const Layout& layout = system_->layout();
  std::vector<double> b(layout.size());
  const auto bu = layout.primal(b), bl = layout.lambda(b);
  const auto penalty = system_->solid().penalties();
  std::vector<double> local(r.force), bound(r.volume.size()), volume(r.volume.size());
  // A ū; the tangent's augmentation acts on ū too, and is undone by the element rows it comes from
  const auto force = system_->nodal_action(prescribed, {}, volume);
  for (std::size_t i = 0; i < local.size(); ++i) local[i] += force[i];
  for (std::size_t e = 0; e < bound.size(); ++e) {
    bl[e] = -(r.volume[e] + volume[e]);
    bound[e] = penalty[e] * r.volume[e];  // A_γ ū holds γ W bᵀ ū already
  }
  std::vector<double> augmentation(local.size());
  system_->solid().apply_pressure(bound, augmentation);
  problem.mesh().halo.accumulate_ghosts(augmentation);
  for (std::size_t i = 0; i < local.size(); ++i) local[i] = -(local[i] + augmentation[i]);
  problem.dofs().reduce(system_->state(), local, bu);
  if (omega_.empty()) return b;
  const auto flux = system_->prescribed_fluxes(prescribed);
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const double D = r.liquid[i] + flux[i];
    add_scaled(system_->liquid_columns()[i], -omega_[i] * D, bu);
    if (layout.liquids > 0) layout.pressures(b)[i] = D;
  }
  return b;
}

double scaled_norm(const CoupledSystem& system, std::span<const double> v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(system.scaling()[i] * v[i], 2);
  return std::sqrt(system.problem().comm().sum(sum));
}

}  // namespace bulbus::inline solve
