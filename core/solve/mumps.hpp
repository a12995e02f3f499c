#pragma once
#include <functional>
#include <memory>
#include <span>

#include "core/base/parallel.hpp"
#include "core/solve/choices.hpp"
#include "core/solve/factorisation.hpp"

namespace bulbus::inline solve {

struct MumpsOptions {
  Precision precision = Precision::full;  ///< of matrix, factors and solutions
  Ordering ordering = Ordering::scotch;
  int block = 1;  ///< unknowns that stand together in nodes, for the analysis: all have so many, side by side
  bool joined = false;  ///< entries that a matrix lacks of the last one become zeros, so that it needs no
                        ///< analysis; triplets come sorted, each once
  int refinements = 0;  ///< most steps of iterative refinement in a solve
  bool null_pivots = false;  ///< pivots that vanish to rounding are found; solutions are those of least norm
  int relaxations = 5;       ///< times that the workspace may be doubled when pivoting outgrows the estimate
  double memory_limit_mb =
      0;  ///< over all ranks: refuse to factorise when matrix and estimate are larger; 0: no limit
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
