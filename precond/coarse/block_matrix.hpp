#pragma once
#include <array>
#include <span>
#include <vector>

namespace bulbus::inline precond {

/// A sparse matrix of 6 × 6 blocks: rows in compressed form, both triangles. On several
/// ranks the rows of this one, columns by local numbers, its own rows first. Blocks on the diagonal and all
/// sums are in double precision, the others in single, which bounds how fast it is read: the energies of a
/// thin wall's bending modes bear that, and do not bear more (docs/decisions/052).
class BlockMatrix {
 public:
  /// Row by row.
  using Block = std::array<double, 36>;

  BlockMatrix() = default;
  /// Zeros at these block rows and columns, each given once.
  BlockMatrix(int rows, std::vector<std::array<int, 2>> places);
  void add(int row, int column, const Block& block);
  /// Once all is added.
  void invert_diagonal();
  int rows() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const int> columns(int row) const {
    return {column_.data() + start_[row], column_.data() + start_[row + 1]};
  }
  /// Of the k-th entry of a row.
  Block block(int row, int k) const;
  std::size_t entries() const { return column_.size(); }

  /// y = A x; six numbers per block row.
  void apply(std::span<const double> x, std::span<double> y) const;
  /// One sweep of block Gauss–Seidel on A x = b from the first block row to the last and from x = 0, for
  /// which half of the matrix is read. `rest`: b − A x without what is right of the diagonal.
  void sweep_forwards(std::span<const double> b, std::span<double> x, std::span<double> rest) const;
  /// rest −= U x, U: what is right of the diagonal. x with ghosts.
  void subtract_upper(std::span<const double> x, std::span<double> rest) const;
  /// One sweep from the last block row to the first, from any x. `step`: by how much it changes x. `rest`: b
  /// − A x without what these steps add left of the diagonal, and those of ghosts.
  void sweep_backwards(std::span<const double> b, std::span<double> x, std::span<double> step,
                       std::span<double> rest) const;
  /// rest −= L step, L: what is left of the diagonal, and columns of ghosts. `step` with ghosts.
  void subtract_lower(std::span<const double> step, std::span<double> rest) const;
  std::size_t bytes() const;

 private:
  using Sum = std::array<double, 8>;  // the last two entries are not used
  void subtract(int first, int last, std::span<const double> x, Sum& sum) const;
  void subtract_diagonal(int row, std::span<const double> x, Sum& sum) const;
  int ghosts_of(int row) const;

  std::vector<int> start_, column_;
  std::vector<int> diagonal_;  // of each block row
  // Column by column, 36 a block; two more at the end, where eight are read.
  std::vector<float> value_;                   // zero on the diagonal
  std::vector<double> on_diagonal_, inverse_;  // blocks on the diagonal and their inverses
};

}  // namespace bulbus::inline precond
