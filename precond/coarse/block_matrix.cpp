#include "precond/coarse/block_matrix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {
namespace {

constexpr int size = 6, of_block = 36, width = 8;

using Square = Eigen::Matrix<double, size, size, Eigen::RowMajor>;

// sum += factor · A x of one block: a whole register for every column, the last two lanes of which are of the
// next one.
inline void add_product(const double* block, const double* x, double factor, std::array<double, width>& sum) {
  for (int j = 0; j < size; ++j) {
    const double xj = factor * x[j];
    for (int i = 0; i < width; ++i) sum[i] += block[size * j + i] * xj;
  }
}

// Of the symmetric part; where it is not positive definite, of its absolute value without small eigenvalues,
// so that a sweep does not blow up what it should smooth.
Square inverse_of(const BlockMatrix::Block& block) {
  // Of the largest eigenvalue. Floats tell what is above ten roundings of 6e-8 from zero; a sweep blows up
  // nothing by more than a hundred, where a lower bound lets it and a higher one slows it down.
  constexpr double definite = 1e-6, least = 1e-2;
  const Eigen::Map<const Square> given(block.data());
  const Eigen::SelfAdjointEigenSolver<Square> spectrum(0.5 * (given + given.transpose()));
  auto values = spectrum.eigenvalues().eval();
  const double largest = values.cwiseAbs().maxCoeff();
  if (largest == 0) return Square::Zero();
  if (values[0] <= definite * largest) values = values.cwiseAbs().cwiseMax(least * largest).eval();
  return spectrum.eigenvectors() * values.cwiseInverse().asDiagonal() * spectrum.eigenvectors().transpose();
}

}  // namespace

BlockMatrix::BlockMatrix(int rows, std::vector<std::array<int, 2>> places)
    : start_(rows + 1),
      column_(places.size()),
      value_(of_block * places.size() + 2),
      inverse_(of_block * rows + 2) {
  std::ranges::sort(places);
  for (const auto& [row, column] : places) ++start_[row + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::ranges::transform(places, column_.begin(), [](const auto& place) { return place[1]; });
}

void BlockMatrix::add(int row, int column, const Block& block) {
  const auto end = column_.begin() + start_[row + 1];
  const auto at = std::lower_bound(column_.begin() + start_[row], end, column);
  if (at == end || *at != column) throw std::invalid_argument("BlockMatrix: there is no such block");
  double* value = &value_[of_block * (at - column_.begin())];
  for (int i = 0; i < of_block; ++i) value[size * (i % size) + i / size] += block[i];
}

void BlockMatrix::invert_diagonal() {
  for (int row = 0; row < rows(); ++row)
    for (int k = start_[row]; k < start_[row + 1]; ++k) {
      if (column_[k] != row) continue;
      const Square inverse = inverse_of(block(row, k - start_[row]));
      for (int i = 0; i < of_block; ++i)
        inverse_[of_block * row + size * (i % size) + i / size] = inverse(i / size, i % size);
    }
}

BlockMatrix::Block BlockMatrix::block(int row, int k) const {
  Block b;
  const double* value = &value_[of_block * (start_[row] + k)];
  for (int i = 0; i < of_block; ++i) b[i] = value[size * (i % size) + i / size];
  return b;
}

void BlockMatrix::subtract(int row, std::span<const double> x, Sum& sum) const {
  for (int k = start_[row]; k < start_[row + 1]; ++k)
    add_product(&value_[of_block * k], &x[size * column_[k]], -1, sum);
}

void BlockMatrix::apply(std::span<const double> x, std::span<double> y) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum{};
    subtract(row, x, sum);
    for (int i = 0; i < size; ++i) y[size * row + i] = -sum[i];
  }
}

void BlockMatrix::residual(std::span<const double> b, std::span<const double> x, std::span<double> r) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum{};
    std::copy_n(&b[size * row], size, sum.begin());
    subtract(row, x, sum);
    std::copy_n(sum.begin(), size, &r[size * row]);
  }
}

void BlockMatrix::sweep(std::span<const double> b, std::span<double> x, bool forwards) const {
  for (int n = 0; n < rows(); ++n) {
    const int row = forwards ? n : rows() - 1 - n;
    Sum sum{}, step{};
    std::copy_n(&b[size * row], size, sum.begin());
    subtract(row, x, sum);
    add_product(&inverse_[of_block * row], sum.data(), 1, step);
    for (int i = 0; i < size; ++i) x[size * row + i] += step[i];
  }
}

std::size_t BlockMatrix::bytes() const {
  return bytes_of(start_) + bytes_of(column_) + bytes_of(value_) + bytes_of(inverse_);
}

}  // namespace bulbus::inline precond
