#pragma once
#include <memory>
#include <span>

#include "core/solve/linear_operator.hpp"
#include "core/solve/settings.hpp"
#include "precond/smoothers/line_jacobi.hpp"

namespace bulbus::inline precond {

/// Chebyshev with line Jacobi on the displacement block A, a symmetric linear map S, beside a coarser space's
/// correction. Primal vectors.
class Smoother {
 public:
  virtual ~Smoother() = default;
  /// x = S b,   r = b − A x. Collective.
  virtual void before(std::span<const double> b, std::span<double> x, std::span<double> r) const = 0;
  /// x += e + S (r − A e) with the r that before() has left, e: a correction without constrained directions.
  /// Collective.
  virtual void after(std::span<const double> e, std::span<double> x) const = 0;
  /// x = e + S (b − A e). Collective.
  virtual void improve(std::span<const double> b, std::span<const double> e, std::span<double> x) const = 0;
  /// See DisplacementPreconditioner. Collective.
  virtual double refresh(SharedSystem system) = 0;
  virtual void release() = 0;
  /// See DampedSpectrum.
  virtual double largest_eigenvalue() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// `largest_eigenvalue`: 0 if it is not known. Collective.
std::unique_ptr<Smoother> make_smoother(SharedSystem system, std::shared_ptr<const LineJacobi> lines,
                                        const SmootherSettings& settings, Precision precision,
                                        double largest_eigenvalue = 0);

}  // namespace bulbus::inline precond
