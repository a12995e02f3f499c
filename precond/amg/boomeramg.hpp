#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline precond {

/// Rows of a square matrix that is distributed by contiguous rows; columns are global numbers.
/// Entries of rows that other ranks own may be given too; whatever is given twice is added.
struct DistributedCsr {
  long long first_row = 0;         ///< first row that this rank owns
  int rows = 0;                    ///< rows that this rank owns
  std::vector<long long> row_ids;  ///< global number of each row below, owned or not
  std::vector<int> start;          ///< row i's entries are start[i] .. start[i + 1]
  std::vector<long long> columns;
  std::vector<double> values;
};

enum class AmgSmoother {
  gauss_seidel,            ///< l1: forward on the way down, backward on the way up
  symmetric_gauss_seidel,  ///< l1: forward and backward on both ways
  jacobi,                  ///< l1
  chebyshev                ///< degree 2
};

struct AmgOptions {
  int functions = 1;  ///< unknowns per node, interleaved; each is coarsened by itself unless nodal
  bool nodal = false;
  double threshold = 0.25;  ///< of strong connections
  int max_per_row = 4;      ///< entries in a row of the interpolation
  int aggressive_levels = 0;
  bool pmis = false;  ///< instead of HMIS: sparser and weaker
  AmgSmoother smoother = AmgSmoother::gauss_seidel;
  int sweeps = 1, cycles = 1;
  /// Vectors that interpolation must keep beside the constants (this rank's part; GM2): the three rotations
  /// of a solid, zero on fixed unknowns, no larger than the constants. Need nodal; the smoother is then
  /// symmetric Gauss-Seidel.
  std::vector<std::vector<double>> rigid_modes = {};
};

/// hypre's BoomerAMG: V-cycles from a zero initial guess. For a symmetric positive matrix it is symmetric
/// positive. Unknowns without a neighbour (identity rows) are allowed.
class BoomerAmg final : public Preconditioner {
 public:
  /// Collective. The matrix is copied. Throws InputError if it has more unknowns than hypre can number,
  /// std::invalid_argument if the parts do not fit together. A matrix that is not finite and failures of
  /// hypre are told by failure().
  BoomerAmg(const DistributedCsr& matrix, const AmgOptions& options, const Comm& comm);
  ~BoomerAmg() override;

  int size() const override;
  /// Without a hierarchy, or if hypre reports an error, y is NaN on this rank.
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override;

  /// Why there is no hierarchy, the same on every rank; empty if there is one.
  const std::string& failure() const;
  int levels() const;
  /// Rows (entries) of all levels over those of the matrix.
  double grid_complexity() const;
  double operator_complexity() const;

 private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> h_;
};

}  // namespace bulbus::inline precond
