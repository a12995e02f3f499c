#include "precond/schur/checkerboard_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/memory.hpp"
#include "precond/schur/checkerboard_assembly.hpp"
#include "precond/smoothers/block_jacobi.hpp"

namespace bulbus::inline precond {
namespace {

using Vector = SinglePack::Vector;

Vector load_vector(const float* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

}  // namespace

CheckerboardMatrix::CheckerboardMatrix(const CoupledSystem& system,
                                       std::shared_ptr<const CheckerboardModes> modes,
                                       const LineJacobi& lines)
    : modes_(std::move(modes)) {
  Assembly assembly(system, *this);
  assembly.add_lines(lines);
  in_.resize(assembly.coarser());
  out_.resize(assembly.coarser());
  exchanged_.resize(modes_->count() * assembly.coarser());
}

// A block is one vector, b00 b01 b02 b03 b10 ...; it meets the four numbers of x side by side four times, and
// what it does to its column stays apart by rows until all are done.
template <>
void CheckerboardMatrix::add_products<4>() const {
  for (std::size_t k = 0; k < pairs_.size();) {
    const int row = pairs_[k].row;
    Vector x, sums{};
    for (int i = 0; i < 16; ++i) x[i] = in_[row][i / 4];
    for (; k < pairs_.size() && pairs_[k].row == row; ++k) {
      const int column = pairs_[k].column;
      const Vector B = load_vector(&blocks_[16 * k]);
      sums += B * in_[column];
      if (column != row) out_[column] += B * x;
    }
    for (int i = 0; i < 16; ++i) out_[row][i / 4] += sums[i];
  }
  for (Vector& y : out_)
    for (int i = 4; i < 16; ++i) y[i % 4] += y[i];
}

// A row of ten is loaded with six numbers behind it, which meet zeros of x or end in lanes that nobody reads.
template <>
void CheckerboardMatrix::add_products<10>() const {
  for (std::size_t k = 0; k < pairs_.size();) {
    const int row = pairs_[k].row;
    Vector sums[10]{};
    for (; k < pairs_.size() && pairs_[k].row == row; ++k) {
      const int column = pairs_[k].column;
      Vector y{};
      for (int i = 0; i < 10; ++i) {
        const Vector B = load_vector(&blocks_[100 * k + 10 * i]);
        sums[i] += B * in_[column];
        y += B * in_[row][i];
      }
      if (column != row) out_[column] += y;
    }
    for (int i = 0; i < 10; ++i)
      for (int j = 0; j < 10; ++j) out_[row][i] += sums[i][j];
  }
}

template <int N>
void CheckerboardMatrix::multiply(std::span<double> x) const {
  for (std::size_t c = 0; c < in_.size(); ++c)
    for (int i = 0; i < (N == 4 ? 16 : N); ++i) in_[c][i] = static_cast<float>(x[N * c + i % N]);
  std::ranges::fill(out_, Vector{});
  add_products<N>();
  for (std::size_t c = 0; c < out_.size(); ++c)
    for (int i = 0; i < N; ++i) x[N * c + i] = out_[c][i];
}

void CheckerboardMatrix::apply(std::span<const double> x, std::span<double> y) const {
  std::ranges::copy(x, exchanged_.begin());
  halo_->update_ghosts(exchanged_, modes_->count());
  if (modes_->count() == 4)
    multiply<4>(exchanged_);
  else
    multiply<10>(exchanged_);
  halo_->accumulate_ghosts(exchanged_, modes_->count());
  std::copy_n(exchanged_.begin(), size(), y.begin());
}

std::vector<double> CheckerboardMatrix::diagonal() const {
  const int numbers = modes_->count() * modes_->count();
  std::vector<double> sum(numbers * in_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (pairs_[k].row == pairs_[k].column)
      std::copy_n(&blocks_[numbers * k], numbers, &sum[numbers * pairs_[k].row]);
  halo_->accumulate_ghosts(sum, numbers);
  sum.resize(numbers * modes_->coarser());
  return sum;
}

void CheckerboardMatrix::drop(double part) {
  const std::size_t numbers = modes_->count() * modes_->count();
  const auto own = diagonal();
  std::vector<double> norm(in_.size());
  for (int c = 0; c < modes_->coarser(); ++c)
    norm[c] = Eigen::VectorXd::Map(&own[numbers * c], numbers).norm();
  halo_->update_ghosts(norm, 1);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [row, column] = pairs_[k];
    const auto block = Eigen::VectorXf::Map(&blocks_[numbers * k], numbers);
    if (row != column && block.norm() < part * std::sqrt(norm[row] * norm[column])) continue;
    std::copy_n(block.data(), numbers, &blocks_[numbers * kept]);
    pairs_[kept++] = pairs_[k];
  }
  blocks_.resize(blocks_.size() - numbers * (pairs_.size() - kept));
  pairs_.resize(kept);
  blocks_.shrink_to_fit();
  pairs_.shrink_to_fit();
}

std::size_t CheckerboardMatrix::bytes() const {
  return bytes_of(pairs_) + bytes_of(blocks_) + bytes_of(in_) + bytes_of(out_) + bytes_of(exchanged_);
}

CheckerboardJacobi::CheckerboardJacobi(const CheckerboardMatrix& matrix)
    : modes_(matrix.modes()), size_(matrix.size()) {
  const int modes = modes_;
  const auto diagonal = matrix.diagonal();
  inverse_.resize(diagonal.size());
  for (std::size_t at = 0; at < diagonal.size(); at += modes * modes) {
    const Eigen::MatrixXd block = Eigen::MatrixXd::Map(&diagonal[at], modes, modes);
    if (block.diagonal().maxCoeff() > 0)
      Eigen::MatrixXf::Map(&inverse_[at], modes, modes) = safe_inverse<Eigen::Dynamic>(block).cast<float>();
  }
}

void CheckerboardJacobi::apply(std::span<const double> r, std::span<double> z) const {
  const int n = modes_;
  for (int at = 0; at < size_; at += n)
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += inverse_[n * (at + i) + j] * r[at + j];
      z[at + i] = sum;
    }
}

std::size_t CheckerboardJacobi::bytes() const { return bytes_of(inverse_); }

void CheckerboardProduct::apply(std::span<const double> x, std::span<double> y) const {
  std::ranges::fill(p_, 0.0);
  modes_->add_prolonged(x, 1, p_);
  K_->apply(p_, q_);
  modes_->restrict_pressures(q_, y);
}

std::size_t CheckerboardProduct::bytes() const { return bytes_of(p_) + bytes_of(q_); }

}  // namespace bulbus::inline precond
