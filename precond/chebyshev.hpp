#pragma once
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus {

/// Chebyshev polynomial in D⁻¹A on [lowest, 1.1]·λ_max from a zero guess: a fixed symmetric linear map that damps the upper
/// part of the spectrum.
class Chebyshev final : public Preconditioner {
 public:
  /// Estimates λ_max(D⁻¹A) by a few Lanczos steps. `A` and `D` must outlive this. Collective.
  Chebyshev(const LinearOperator& A, const Preconditioner& D, int degree, double smoothed_part, const Comm& comm);
  int size() const override { return A_.size(); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool fixed() const override { return true; }
  /// Estimates the largest eigenvalue of the present A; D fits as long as it has not grown much: stiffness that is new, of a contact, D
  /// knows nothing of.
  bool follow() override;
  std::size_t bytes() const override;
  double largest_eigenvalue() const { return largest_; }

 private:
  const LinearOperator& A_;
  const Preconditioner& D_;
  int degree_;
  double smoothed_part_, own_, lowest_ = 0, largest_ = 0;
  Comm comm_;
  mutable std::vector<double> r_, z_, d_;
};

/// Extreme real parts of the eigenvalues of D⁻¹A as Lanczos sees them after `steps` steps from a fixed random vector; neither A nor
/// D needs to be definite. Collective.
struct Spectrum {
  double smallest, largest;
};
Spectrum lanczos(const LinearOperator& A, const Preconditioner& D, int steps, const Comm& comm);

}  // namespace bulbus
