#include "core/solve/anderson.hpp"

#include <cmath>
#include <numeric>

#include "core/base/dense.hpp"

namespace bulbus::inline solve {
namespace {

// Directions in which differences of this relative size cancel say nothing: the squares are rounding.
constexpr double least_eigenvalue = 1e-12;

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
  std::vector<double> d(a.begin(), a.end());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
  return d;
}

}  // namespace

void AndersonAcceleration::add(std::span<const double> x, std::span<const double> f) {
  if (!x_.empty()) differences_.push_front({difference(x, x_), difference(f, f_)});
  if (std::ssize(differences_) > depth_) differences_.pop_back();
  x_.assign(x.begin(), x.end());
  f_.assign(f.begin(), f.end());
}

// By normal equations of columns that are scaled to 1, without the directions that are rounding.
std::vector<double> AndersonAcceleration::coefficients(std::span<const double> f) const {
  const auto m = static_cast<int>(differences_.size());
  const auto product = [&](std::span<const double> a, std::span<const double> b) {
    return std::inner_product(a.begin(), a.begin() + static_cast<long>(owned_), b.begin(), 0.0);
  };
  std::vector<double> sums;
  for (int i = 0; i < m; ++i) {
    sums.push_back(product(differences_[i].f, f));
    for (int j = 0; j < m; ++j) sums.push_back(product(differences_[i].f, differences_[j].f));
  }
  comm_.sum(sums);
  std::vector<double> gram(m * m), right(m), scale(m), gamma(m);
  for (int i = 0; i < m; ++i) {
    const double square = sums[i * (m + 1) + 1 + i];
    scale[i] = square > 0 ? 1 / std::sqrt(square) : 0;
  }
  for (int i = 0; i < m; ++i) {
    right[i] = scale[i] * sums[i * (m + 1)];
    for (int j = 0; j < m; ++j) gram[i * m + j] = scale[i] * scale[j] * sums[i * (m + 1) + 1 + j];
  }
  const SymmetricEigen eigen = symmetric_eigen(gram);
  for (int k = 0; k < m; ++k) {
    if (!(eigen.values[k] > least_eigenvalue * m)) continue;
    const auto v = eigen.vector(k);
    const double part = std::inner_product(v.begin(), v.end(), right.begin(), 0.0) / eigen.values[k];
    for (int i = 0; i < m; ++i) gamma[i] += scale[i] * part * v[i];
  }
  return gamma;
}

std::vector<double> AndersonAcceleration::next(std::span<const double> x, std::span<const double> f) {
  add(x, f);
  std::vector<double> result(x.begin(), x.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += f[i];
  if (differences_.empty()) return result;
  const auto gamma = coefficients(f);
  for (std::size_t k = 0; k < gamma.size(); ++k)
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] -= gamma[k] * (differences_[k].x[i] + differences_[k].f[i]);
  return result;
}

}  // namespace bulbus::inline solve
