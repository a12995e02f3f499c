#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace bulbus::inline solve {

/// Of numbers that an approximation keeps.
enum class Precision { full, single };

/// A linear map between distributed vectors of which every rank holds size() entries.
class LinearOperator {
 public:
  virtual ~LinearOperator() = default;
  /// Entries on this rank.
  virtual int size() const = 0;
  /// y = A x on this rank's part of a distributed vector; y is overwritten, even if it held NaN. Collective.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;
};

/// An approximate inverse: y ≈ A⁻¹ x.
class Preconditioner : public LinearOperator {
 public:
  /// True if apply is one linear map, the same each time, be it rounded to single precision: needed by every
  /// Krylov method that is not flexible.
  virtual bool is_linear() const = 0;
  /// Why it cannot be used, the same on every rank; empty if it can.
  virtual std::string setup_error() const { return {}; }
  /// Bytes held on this rank.
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace bulbus::inline solve
