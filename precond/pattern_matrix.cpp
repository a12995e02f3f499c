#include "precond/pattern_matrix.hpp"

#include <algorithm>

#include "core/base/memory.hpp"
#include "precond/block_jacobi.hpp"
#include "precond/pattern_assembly.hpp"

namespace bulbus {

PatternMatrix::PatternMatrix(const Problem& problem, const Patterns& patterns, const LineJacobi& lines) : patterns_(patterns) {
  Assembly assembly(problem, *this);
  assembly.add_lines(lines);
  in_.resize(patterns.count() * assembly.coarser());
  out_.resize(in_.size());
  exchanged_.resize(in_.size());
}

template <int N>
void PatternMatrix::add_products() const {
  using Vector = Eigen::Matrix<float, N, 1>;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [row, column] = pairs_[k];
    const auto B = Eigen::Matrix<float, N, N>::Map(&blocks_[N * N * k]);
    Vector::Map(&out_[N * row]).noalias() += B.lazyProduct(Vector::Map(&in_[N * column]));
    if (row != column) Vector::Map(&out_[N * column]).noalias() += B.transpose().lazyProduct(Vector::Map(&in_[N * row]));
  }
}

void PatternMatrix::apply(std::span<const double> x, std::span<double> y) const {
  std::ranges::copy(x, exchanged_.begin());
  halo_->update(exchanged_, patterns_.count());
  std::ranges::transform(exchanged_, in_.begin(), [](double v) { return static_cast<float>(v); });
  std::ranges::fill(out_, 0.f);
  if (patterns_.count() == 4) add_products<4>();
  else add_products<10>();
  std::ranges::copy(out_, exchanged_.begin());
  halo_->fold(exchanged_, patterns_.count());
  std::copy_n(exchanged_.begin(), size(), y.begin());
}

std::vector<double> PatternMatrix::diagonal() const {
  const int numbers = patterns_.count() * patterns_.count();
  std::vector<double> sum(patterns_.count() * in_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (pairs_[k].row == pairs_[k].column) std::copy_n(&blocks_[numbers * k], numbers, &sum[numbers * pairs_[k].row]);
  halo_->fold(sum, numbers);
  sum.resize(numbers * patterns_.coarser());
  return sum;
}

std::size_t PatternMatrix::bytes() const { return bytes_of(pairs_) + bytes_of(blocks_) + bytes_of(in_) + bytes_of(out_) + bytes_of(exchanged_); }

PatternJacobi::PatternJacobi(const PatternMatrix& matrix) : patterns_(matrix.patterns()), size_(matrix.size()) {
  const int patterns = patterns_;
  const auto diagonal = matrix.diagonal();
  inverse_.resize(diagonal.size());
  for (std::size_t at = 0; at < diagonal.size(); at += patterns * patterns) {
    const Eigen::MatrixXd block = Eigen::MatrixXd::Map(&diagonal[at], patterns, patterns);
    if (block.diagonal().maxCoeff() > 0) Eigen::MatrixXf::Map(&inverse_[at], patterns, patterns) = safe_inverse<Eigen::Dynamic>(block).cast<float>();
  }
}

void PatternJacobi::apply(std::span<const double> r, std::span<double> z) const {
  const int n = patterns_;
  for (int at = 0; at < size_; at += n)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += inverse_[n * (at + i) + j] * r[at + j];
      z[at + i] = sum;
    }
}

std::size_t PatternJacobi::bytes() const { return bytes_of(inverse_); }

void PatternProduct::apply(std::span<const double> x, std::span<double> y) const {
  std::ranges::fill(p_, 0.0);
  patterns_.add_prolonged(x, 1, p_);
  K_.apply(p_, q_);
  patterns_.restrict_pressures(q_, y);
}

std::size_t PatternProduct::bytes() const { return bytes_of(p_) + bytes_of(q_); }

}  // namespace bulbus
