#include "precond/smoothers/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/dense.hpp"
#include "core/base/inner_product.hpp"
#include "core/base/memory.hpp"

namespace bulbus::inline precond {

// The coefficients of preconditioned conjugate gradients are those of Lanczos on D^(-½) A D^(-½). They stand
// for an indefinite D too: T is then symmetric up to signs, and its eigenvalues may be complex.
Spectrum lanczos(const LinearOperator& A, const Preconditioner& D, int steps, const Comm& comm) {
  const std::size_t n = A.size();
  std::vector<double> r(n), z(n), p(n), q(n);
  std::mt19937 random(1 + comm.rank());
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (double& v : r) v = uniform(random);
  D.apply(r, z);
  p = z;
  double rz = inner_product(r, z, comm), beta = 0, alpha = 1;
  std::vector<double> diagonal, off;
  const double least =
      1e-11 * std::abs(rz);  // below it the rounding of single precision makes eigenvalues of its own
  for (int k = 0; k < steps && std::abs(rz) > least; ++k) {
    A.apply(p, q);
    const double before = alpha, pq = inner_product(p, q, comm);
    if (pq == 0 || !std::isfinite(pq)) break;
    alpha = rz / pq;
    diagonal.push_back(1 / alpha + (k > 0 ? beta / before : 0));
    if (k > 0) off.push_back(std::copysign(std::sqrt(std::abs(beta)) / before, beta));
    for (std::size_t i = 0; i < n; ++i) r[i] -= alpha * q[i];
    D.apply(r, z);
    const double next = inner_product(r, z, comm);
    beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < n; ++i) p[i] = z[i] + beta * p[i];
  }
  if (diagonal.empty()) return {1, 1};
  const std::size_t m = diagonal.size();
  std::vector<double> T(m * m);
  for (std::size_t k = 0; k < m; ++k) {
    T[k * m + k] = diagonal[k];
    if (k > 0) T[k * m + k - 1] = std::abs(off[k - 1]), T[(k - 1) * m + k] = off[k - 1];
  }
  const auto values = eigenvalues_real_parts(T);
  const auto [lowest, highest] = std::ranges::minmax(values);
  return {lowest, highest};
}

DampedSpectrum::DampedSpectrum(std::shared_ptr<const LinearOperator> A,
                               std::shared_ptr<const Preconditioner> D, double lowest, const Comm& comm,
                               double largest)
    : A_(std::move(A)), D_(std::move(D)), part_(lowest), largest_(largest), comm_(comm) {
  if (largest_ == 0) refresh();
  own_ = largest_;
}

double DampedSpectrum::refresh() {
  constexpr int steps = 10;
  constexpr double reserve = 1.1;  // what lies above the interval is amplified (docs/decisions/012)
  const double estimate = lanczos(*A_, *D_, steps, comm_).largest;
  largest_ = reserve * (estimate > 0 ? estimate : 1);
  return largest_ / own_;
}

Chebyshev::Chebyshev(std::shared_ptr<const LinearOperator> A, std::shared_ptr<const Preconditioner> D,
                     int degree, double smoothing_range, const Comm& comm, double largest)
    : A_(std::move(A)),
      D_(std::move(D)),
      degree_(degree),
      spectrum_(A_, D_, smoothing_range, comm, largest),
      r_(A_->size()),
      z_(A_->size()),
      d_(A_->size()) {}

void Chebyshev::apply(std::span<const double> b, std::span<double> x) const {
  auto steps = spectrum_.steps();
  std::ranges::copy(b, r_.begin());
  std::ranges::fill(x, 0);
  std::ranges::fill(d_, 0);
  for (int k = 0; k < degree_; ++k) {
    if (k > 0) {
      A_->apply(d_, z_);
      for (std::size_t i = 0; i < r_.size(); ++i) r_[i] -= z_[i];
    }
    D_->apply(r_, z_);
    const auto [keep, add] = steps.next();
    for (std::size_t i = 0; i < d_.size(); ++i) {
      d_[i] = keep * d_[i] + add * z_[i];
      x[i] += d_[i];
    }
  }
}

std::size_t Chebyshev::bytes() const { return bytes_of(r_) + bytes_of(z_) + bytes_of(d_); }

}  // namespace bulbus::inline precond
