#pragma once
#include <span>
#include <string>

#include "core/solve/triplets.hpp"

namespace bulbus::inline solve {

/// What analysis foretold and the factorisation found. Memory in MB (10⁶ bytes).
struct FactorReport {
  bool ok = false;
  bool kept = false;          ///< they are those of an earlier matrix
  std::string reason;         ///< why not ok
  int code = 0;               ///< the library's own: of MUMPS INFOG(1)
  bool too_large = false;     ///< refused by its estimate
  std::string ordering;       ///< the one that ran
  double matrix_entries = 0;  ///< of all ranks; of a symmetric matrix those of one triangle
  double estimated_mb = 0, estimated_max_mb = 0;  ///< of all ranks; of the greediest one
  double estimated_flops = 0, estimated_entries = 0;
  double memory_mb = 0, memory_max_mb = 0;  ///< really used
  double flops = 0, factor_entries = 0;
  int negative_pivots = 0;  ///< of a symmetric matrix: its number of negative eigenvalues; -1: not known
  int null_pivots = 0;      ///< where they are looked for: the dimension of the null space
  int relaxations = 0;
  double seconds_analysis = 0, seconds_factorisation = 0;
  /// Eigenvalues of a symmetric matrix that are not positive; -1 if not known. A checkerboard mode that no
  /// displacement strains has the eigenvalue zero, and counts as the constraint that it is.
  int nonpositive() const { return negative_pivots < 0 ? -1 : negative_pivots + null_pivots; }
};

/// Is the matrix singular and the right-hand side outside of its range? Within it the reduction is that of
/// rounding.
inline bool unsolvable(const FactorReport& f, double reduction) {
  return f.null_pivots > 0 && !(reduction < 1e-6);
}

/// A sparse direct solver, for one matrix after the other. All members are collective.
class Factorisation {
 public:
  virtual ~Factorisation() = default;
  /// Of a symmetric matrix: does its upper triangle do?
  virtual bool takes_upper_triangle() const { return false; }
  /// Of the matrix that is the sum of all ranks' triplets. `rows`: how many of its rows this rank's vectors
  /// have, in the order of the ranks.
  virtual FactorReport factorise(Triplets matrix, int rows, bool symmetric) = 0;
  /// A x = b. False without factors or if the library fails; x is then not touched.
  virtual bool solve(std::span<const double> b, std::span<double> x) = 0;
};

}  // namespace bulbus::inline solve
