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
template <class Number>
inline void add_product(const Number* block, const double* x, double factor, std::array<double, width>& sum) {
  for (int j = 0; j < size; ++j) {
    const double xj = factor * x[j];
    for (int i = 0; i < width; ++i) sum[i] += block[size * j + i] * xj;
  }
}

inline std::array<double, width> sum_of(std::span<const double> b, int row) {
  std::array<double, width> sum{};
  std::copy_n(&b[size * row], size, sum.begin());
  return sum;
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
      on_diagonal_(of_block * rows + 2),
      inverse_(of_block * rows + 2) {
  std::ranges::sort(places);
  for (const auto& [row, column] : places) ++start_[row + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::ranges::transform(places, column_.begin(), [](const auto& place) { return place[1]; });
  for (int row = 0; row < rows; ++row) {
    const auto first = column_.begin() + start_[row], end = column_.begin() + start_[row + 1];
    const auto at = std::lower_bound(first, end, row);
    if (at == end || *at != row) throw std::invalid_argument("BlockMatrix: a row without a diagonal block");
    diagonal_.push_back(static_cast<int>(at - column_.begin()));
  }
}

void BlockMatrix::add(int row, int column, const Block& block) {
  const auto end = column_.begin() + start_[row + 1];
  const auto at = std::lower_bound(column_.begin() + start_[row], end, column);
  if (at == end || *at != column) throw std::invalid_argument("BlockMatrix: there is no such block");
  const auto add_to = [&](auto* value) {
    for (int i = 0; i < of_block; ++i) value[size * (i % size) + i / size] += block[i];
  };
  if (column == row)
    add_to(&on_diagonal_[of_block * static_cast<std::size_t>(row)]);
  else
    add_to(&value_[of_block * (at - column_.begin())]);
}

void BlockMatrix::invert_diagonal() {
  for (int row = 0; row < rows(); ++row) {
    const Square inverse = inverse_of(block(row, diagonal_[row] - start_[row]));
    for (int i = 0; i < of_block; ++i)
      inverse_[of_block * row + size * (i % size) + i / size] = inverse(i / size, i % size);
  }
}

BlockMatrix::Block BlockMatrix::block(int row, int k) const {
  Block b;
  const auto copy = [&](const auto* value) {
    for (int i = 0; i < of_block; ++i) b[i] = value[size * (i % size) + i / size];
  };
  if (start_[row] + k == diagonal_[row])
    copy(&on_diagonal_[of_block * static_cast<std::size_t>(row)]);
  else
    copy(&value_[of_block * static_cast<std::size_t>(start_[row] + k)]);
  return b;
}

// Of entries first, …, last − 1, but not those on the diagonal.
void BlockMatrix::subtract(int first, int last, std::span<const double> x, Sum& sum) const {
  for (int k = first; k < last; ++k)
    add_product(&value_[of_block * static_cast<std::size_t>(k)], &x[size * column_[k]], -1, sum);
}

void BlockMatrix::subtract_diagonal(int row, std::span<const double> x, Sum& sum) const {
  add_product(&on_diagonal_[of_block * static_cast<std::size_t>(row)], &x[size * row], -1, sum);
}

int BlockMatrix::ghosts_of(int row) const {
  int k = start_[row + 1];
  while (k > diagonal_[row] + 1 && column_[k - 1] >= rows()) --k;
  return k;
}

void BlockMatrix::apply(std::span<const double> x, std::span<double> y) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum{};
    subtract(start_[row], start_[row + 1], x, sum);
    subtract_diagonal(row, x, sum);
    for (int i = 0; i < size; ++i) y[size * row + i] = -sum[i];
  }
}

void BlockMatrix::sweep_forwards(std::span<const double> b, std::span<double> x,
                                 std::span<double> rest) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum = sum_of(b, row), step{};
    subtract(start_[row], diagonal_[row], x, sum);
    add_product(&inverse_[of_block * row], sum.data(), 1, step);
    std::copy_n(step.begin(), size, &x[size * row]);
    subtract_diagonal(row, x, sum);
    std::copy_n(sum.begin(), size, &rest[size * row]);
  }
}

void BlockMatrix::subtract_upper(std::span<const double> x, std::span<double> rest) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum = sum_of(rest, row);
    subtract(diagonal_[row] + 1, start_[row + 1], x, sum);
    std::copy_n(sum.begin(), size, &rest[size * row]);
  }
}

void BlockMatrix::sweep_backwards(std::span<const double> b, std::span<double> x, std::span<double> step,
                                  std::span<double> rest) const {
  for (int row = rows() - 1; row >= 0; --row) {
    Sum sum = sum_of(b, row), s{};
    subtract(start_[row], start_[row + 1], x, sum);
    subtract_diagonal(row, x, sum);
    add_product(&inverse_[of_block * row], sum.data(), 1, s);
    std::copy_n(s.begin(), size, &step[size * row]);
    for (int i = 0; i < size; ++i) x[size * row + i] += s[i];
    subtract_diagonal(row, step, sum);
    std::copy_n(sum.begin(), size, &rest[size * row]);
  }
}

void BlockMatrix::subtract_lower(std::span<const double> step, std::span<double> rest) const {
  for (int row = 0; row < rows(); ++row) {
    Sum sum = sum_of(rest, row);
    subtract(start_[row], diagonal_[row], step, sum);
    subtract(ghosts_of(row), start_[row + 1], step, sum);
    std::copy_n(sum.begin(), size, &rest[size * row]);
  }
}

std::size_t BlockMatrix::bytes() const {
  return bytes_of(start_) + bytes_of(column_) + bytes_of(diagonal_) + bytes_of(value_) +
         bytes_of(on_diagonal_) + bytes_of(inverse_);
}

}  // namespace bulbus::inline precond
