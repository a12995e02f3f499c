#include "precond/block_triangular.hpp"

#include "core/base/inner_product.hpp"
#include "core/base/memory.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/smoothers/chebyshev.hpp"

namespace bulbus::inline precond {

BlockTriangular::BlockTriangular(SharedSystem system,
                                 std::shared_ptr<const DisplacementPreconditioner> displacement,
                                 const PressureSettings& pressures,
                                 std::shared_ptr<SchurCorrections> corrections,
                                 std::shared_ptr<LiquidColumns> columns)
    : system_(std::move(system)),
      displacement_(std::move(displacement)),
      inverse_schur_(system_, displacement_->lines(), pressures, std::move(corrections)),
      Z_(columns),
      column_(system_->liquid_columns().size()),
      work_(system_->layout().primal()) {
  const auto& g = system_->liquid_columns();
  for (int i = 0; i < static_cast<int>(g.size()); ++i)
    if (system_->problem().liquids()[i].enclosed()) coupled_.push_back(i);
  const int n = static_cast<int>(coupled_.size());
  if (columns->size() != coupled_.size()) {
    columns->clear();
    for (int i : coupled_) displacement_->apply(g[i], columns->emplace_back(g[i].size()));
  }
  auto& omega = augmentation_.omega;
  omega.resize(g.size());
  if (n == 0) return;
  Eigen::MatrixXd H(n, n), Omega = Eigen::MatrixXd::Zero(n, n), C = Omega, column = Omega;
  for (int j = 0; j < n; ++j) {
    const auto products = liquid_products((*Z_)[j]);
    for (int i = 0; i < n; ++i) H(i, j) = products[i];
  }
  for (int i = 0; i < n; ++i) {
    const int k = coupled_[i];
    if (H(i, i) > 0) omega[k] = 1 / H(i, i);
  }
  const CoupledOperator A(system_, augmentation_);
  for (int i = 0; i < n; ++i) {
    Omega(i, i) = A.omega()[coupled_[i]];
    C(i, i) = system_->compliance(coupled_[i]);
    column(i, i) = column_[coupled_[i]] = A.column_part(coupled_[i]);
  }
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  woodbury_ = Omega * (I + H * Omega).inverse();
  const Eigen::MatrixXd H_omega = H - H * woodbury_ * H;
  inverse_liquid_schur_ = (C + H_omega * column).inverse();
}

// gᵀ v of every coupled liquid. Collective.
std::vector<double> BlockTriangular::liquid_products(std::span<const double> v) const {
  std::vector<double> products;
  for (int i : coupled_) products.push_back(local_inner_product(system_->liquid_columns()[i], v));
  system_->problem().comm().sum(products);
  return products;
}

void BlockTriangular::apply(std::span<const double> r, std::span<double> z) const {
  const Layout& layout = system_->layout();
  const auto zu = layout.primal(z), zl = layout.lambda(z), zP = layout.pressures(z);
  const auto ru = layout.primal(r), rl = layout.lambda(r), rP = layout.pressures(r);
  inverse_schur_.apply(rl, zl);
  for (double& v : zl) v = -v;
  std::copy(ru.begin(), ru.end(), work_.begin());
  system_->add_pressure_force(zl, -1, work_);

  const int n = static_cast<int>(coupled_.size());
  std::vector<double> P(system_->liquid_columns().size());
  for (int i = 0; i < layout.liquids; ++i) zP[i] = -rP[i] / system_->compliance(i);
  if (n > 0) {
    if (layout.liquids > 0) {
      Eigen::VectorXd part(n);
      for (int i = 0; i < n; ++i) part[i] = rP[coupled_[i]];
      const Eigen::VectorXd solved = -inverse_liquid_schur_ * part;
      for (int i = 0; i < n; ++i) zP[coupled_[i]] = solved[i];
      std::copy(zP.begin(), zP.end(), P.begin());
    }
    system_->problem().comm().broadcast(P);
    for (int i : coupled_) add_scaled(system_->liquid_columns()[i], column_[i] * P[i], work_);
  }
  displacement_->apply(work_, zu);
  if (n == 0) return;
  const auto products = liquid_products(zu);
  const Eigen::VectorXd correction = woodbury_ * Eigen::Map<const Eigen::VectorXd>(products.data(), n);
  for (int i = 0; i < n; ++i) add_scaled((*Z_)[i], -correction[i], zu);
}

std::array<double, 2> BlockTriangular::displacement_spectrum() const {
  const Spectrum s = lanczos(DisplacementBlock(system_), *displacement_, 20, system_->problem().comm());
  return {s.smallest, s.largest};
}

std::size_t BlockTriangular::bytes() const {
  std::size_t total = displacement_->bytes() + inverse_schur_.bytes() + bytes_of(work_);
  for (const auto& z : *Z_) total += bytes_of(z);
  return total;
}

}  // namespace bulbus::inline precond
