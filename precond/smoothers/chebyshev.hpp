#pragma once
#include <memory>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline precond {

/// Extreme real parts of the eigenvalues of D⁻¹A as Lanczos sees them after `steps` steps from a fixed random
/// vector; neither A nor D needs to be definite. Collective.
struct Spectrum {
  double smallest, largest;
};
Spectrum lanczos(const LinearOperator& A, const Preconditioner& D, int steps, const Comm& comm);

/// The part 1.1 [lowest, 1]·λ of the spectrum of D⁻¹A that a Chebyshev polynomial damps; λ: the estimate of
/// λ_max.
class DampedSpectrum {
 public:
  /// Estimates λ_max by a few Lanczos steps, unless it is given. Collective.
  DampedSpectrum(std::shared_ptr<const LinearOperator> A, std::shared_ptr<const Preconditioner> D,
                 double lowest, const Comm& comm, double largest = 0);
  /// Estimates the largest eigenvalue of the present A; returns by how much it has grown since D was made: of
  /// stiffness that is new, as of a contact, D knows nothing. Collective.
  double refresh();
  double largest_eigenvalue() const { return largest_; }

  /// The polynomial's recurrence: d ← keep d + add D⁻¹ r, x += d, with r = b − A x.
  class Steps {
   public:
    Steps(double lowest, double largest)
        : center_(.5 * (largest + lowest)), radius_(.5 * (largest - lowest)) {}
    struct Step {
      double keep, add;
    };
    Step next() {
      const double before = rho_;
      rho_ = before == 0 ? radius_ / center_ : 1 / (2 * center_ / radius_ - before);
      return before == 0 ? Step{0, 1 / center_} : Step{rho_ * before, 2 * rho_ / radius_};
    }

   private:
    double center_, radius_, rho_ = 0;
  };
  Steps steps() const { return {part_ * largest_, largest_}; }

 private:
  std::shared_ptr<const LinearOperator> A_;
  std::shared_ptr<const Preconditioner> D_;
  double part_, own_ = 0, largest_;
  Comm comm_;
};

/// Chebyshev polynomial in D⁻¹A from a zero guess: a fixed symmetric linear map that damps the upper part of
/// the spectrum.
class Chebyshev final : public Preconditioner {
 public:
  /// `smoothing_range`: damped eigenvalues over the largest one, from this on. Collective.
  Chebyshev(std::shared_ptr<const LinearOperator> A, std::shared_ptr<const Preconditioner> D, int degree,
            double smoothing_range, const Comm& comm, double largest = 0);
  int size() const override { return A_->size(); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool is_linear() const override { return true; }
  /// See DampedSpectrum.
  double refresh() { return spectrum_.refresh(); }
  std::size_t bytes() const override;
  double largest_eigenvalue() const { return spectrum_.largest_eigenvalue(); }

 private:
  std::shared_ptr<const LinearOperator> A_;
  std::shared_ptr<const Preconditioner> D_;
  int degree_;
  DampedSpectrum spectrum_;
  mutable std::vector<double> r_, z_, d_;
};

}  // namespace bulbus::inline precond
