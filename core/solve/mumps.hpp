#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/triplets.hpp"

namespace bulbus::inline solve {

enum class MumpsOrdering { amd = 0, scotch = 3, pord = 4, metis = 5, qamd = 6, automatic = 7 };

struct MumpsOptions {
  Precision precision = Precision::full;  ///< of matrix, factors and solutions
  MumpsOrdering ordering = MumpsOrdering::scotch;
  int block = 1;  ///< unknowns that stand together in nodes, for the analysis: all have so many, side by side
  bool joined = false;  ///< entries that a matrix lacks of the last one become zeros, so that it needs no
                        ///< analysis; triplets come sorted, each once
  int refinements = 0;  ///< most steps of iterative refinement in a solve
  int relaxations = 5;  ///< times that the workspace may be doubled when pivoting outgrows the estimate
  double memory_limit_mb =
      0;  ///< over all ranks: refuse to factorise when matrix and estimate are larger; 0: no limit
};

/// What analysis foretold and the factorisation found. Memory in MB (10⁶ bytes).
struct FactorReport {
  bool ok = false;
  bool kept = false;          ///< they are those of an earlier matrix
  std::string reason;         ///< why not ok
  int code = 0;               ///< INFOG(1)
  bool too_large = false;     ///< refused by its estimate
  std::string ordering;       ///< the one that ran
  double matrix_entries = 0;  ///< of all ranks; of a symmetric matrix those of one triangle
  double estimated_mb = 0, estimated_max_mb = 0;  ///< of all ranks; of the greediest one
  double estimated_flops = 0, estimated_entries = 0;
  double memory_mb = 0, memory_max_mb = 0;  ///< really used
  double flops = 0, factor_entries = 0;
  int negative_pivots = 0;  ///< of a symmetric matrix: its number of negative eigenvalues
  int relaxations = 0;
  double seconds_analysis = 0, seconds_factorisation = 0;
};

/// May factors stay for a matrix of the same pattern, no row of which differs from theirs by more than this
/// part of its magnitude? Empty: never.
using KeepFactors = std::function<bool(double change)>;

/// The sparse direct solver MUMPS: L D Lᵀ of a symmetric indefinite matrix or L U. All members are
/// collective.
class Mumps {
 public:
  explicit Mumps(const Comm& comm, MumpsOptions options = {});
  ~Mumps();
  Mumps(const Mumps&) = delete;
  Mumps& operator=(const Mumps&) = delete;

  /// Estimates only. Of a symmetric matrix both triangles may be given; the lower one is not read.
  /// Throws InputError if n does not fit into 32 bits, std::invalid_argument if an entry is outside.
  FactorReport analyse(Triplets matrix, long long n, bool symmetric);
  /// The same and the factors. A matrix with the rows and columns of the last one is not analysed anew.
  /// `keep` is asked on every rank with the same change.
  FactorReport factorise(Triplets matrix, long long n, bool symmetric, const KeepFactors& keep = {});
  /// A x = b, both distributed by contiguous rows in the order of the ranks. False without factors or if
  /// MUMPS fails; x is then not touched.
  bool solve(std::span<const double> b, std::span<double> x);

 private:
  struct Instance;
  template <class Id>
  struct InstanceOf;
  std::unique_ptr<Instance> m_;
};

}  // namespace bulbus::inline solve
