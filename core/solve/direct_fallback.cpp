#include "core/solve/direct_fallback.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/inner_product.hpp"
#include "core/base/memory.hpp"
#include "core/solve/assemble.hpp"
#include "core/solve/direct_memory.hpp"

namespace bulbus::inline solve {
namespace {

constexpr int refinements =
    3;  // each gains the digits that the factors hold, and the loop ends where none does
// A factorisation then takes some hundredths of a second, as much as a few dozen Krylov iterations
// (docs/decisions/017).
constexpr long long few_unknowns = 2000;

// Right-hand side of the system without augmentation: γ B W times the hexahedra's rows and ω g times the
// liquids' are taken out again.
std::vector<double> without_augmentation(const CoupledOperator& A, std::span<const double> b) {
  const CoupledSystem& system = A.system();
  std::vector<double> plain(b.begin(), b.end());
  const auto primal = system.layout().primal(std::span(plain));
  const auto penalty = system.solid().penalties();
  const auto hexes = system.layout().lambda(b);
  std::vector<double> bound(hexes.size());
  for (std::size_t e = 0; e < bound.size(); ++e) bound[e] = penalty[e] * hexes[e];
  system.add_pressure_force(bound, -1, primal);
  const auto liquid = shared_pressures(system, b);
  for (std::size_t i = 0; i < liquid.size(); ++i)
    add_scaled(system.liquid_columns()[i], A.omega()[i] * liquid[i], primal);
  return plain;
}

// x = A⁻¹ b by the factors of the system without augmentation.
bool solve_once(const CoupledOperator& A, Mumps& mumps, std::span<const double> b, std::span<double> x) {
  const CoupledSystem& system = A.system();
  if (!mumps.solve(without_augmentation(A, b), x)) return false;
  if (!system.eliminated()) return true;
  for (int i = 0; i < system.layout().liquids; ++i)  // its unknown is ΔP + gᵀ Δu K/V_i
    if (system.problem().liquids()[i].enclosed())
      system.layout().pressures(x)[i] = -system.layout().pressures(b)[i] / system.compliance(i);
  return true;
}

}  // namespace

DirectFallback::DirectFallback(const LinearSettings& settings, Profiler& profiler)
    : allowed_(settings.fallback == Fallback::direct),
      limit_mb_(settings.allowed_mb()),
      profiler_(profiler) {}

double DirectFallback::available_mb(const Comm& comm) const {
  constexpr double least = 1e-3;  // 0 would be no limit
  return std::max(least, comm.min(limit_mb_) - 1e-6 * comm.sum(static_cast<double>(resident_bytes())));
}

bool DirectFallback::available(const Problem& problem) {
  if (!allowed_) return false;
  if (!fits_) {
    const long long unknowns = unknowns_of(problem);
    const double hexes = static_cast<double>(problem.mesh().all_hexes);
    fits_ = unknowns <= most_assembled &&
            1e-6 * (direct_matrix_bytes(hexes, problem.symmetric()) +
                    direct_factor_bytes(static_cast<double>(unknowns), hexes,
                                        static_cast<double>(problem.mesh().all_nodes), problem.comm().size(),
                                        problem.symmetric())) <
                available_mb(problem.comm());
  }
  return *fits_;
}

bool DirectFallback::cheap(const Problem& problem) const {
  return allowed_ && unknowns_of(problem) <= few_unknowns;
}

FactorReport DirectFallback::factorise(const CoupledSystem& system, Mumps& mumps) {
  const auto scope = profiler_.clock.measure("factorisation");
  const bool symmetric = system.problem().symmetric();
  const FactorReport factor =
      mumps.factorise(assemble_plain(system, symmetric ? Triangles::upper : Triangles::both),
                      global_size(system.problem()), symmetric);
  if (factor.too_large) fits_ = false;
  profiler_.memory.set("factor", static_cast<std::size_t>(factor.memory_max_mb * 1e6));
  return factor;
}

LinearReport DirectFallback::solve(const CoupledOperator& A, std::span<const double> b, std::span<double> x,
                                   double tolerance) {
  const CoupledSystem& system = A.system();
  Mumps mumps(system.problem().comm(),
              {.null_pivots = true, .memory_limit_mb = available_mb(system.problem().comm())});
  const FactorReport factor = factorise(system, mumps);
  LinearReport report{.negative_pivots = system.problem().symmetric() ? factor.nonpositive() : -1,
                      .factor = factor};
  if (!factor.ok) return report.reason = "MUMPS: " + factor.reason, report;
  std::vector<double> r(b.begin(), b.end()), dx(b.size());
  const double scale = scaled_norm(system, b);
  std::ranges::fill(x, 0.0);
  report.reduction = scale > 0 ? 1 : 0;
  const auto misses = [&](double reduction) {
    return reduction > tolerance || unsolvable(factor, reduction);
  };
  for (int i = 0; i <= refinements && misses(report.reduction); ++i) {
    if (!solve_once(A, mumps, r, dx)) return report.reason = "MUMPS could not solve", report;
    for (std::size_t k = 0; k < dx.size(); ++k) dx[k] += x[k];
    A.apply(dx, r);
    for (std::size_t k = 0; k < r.size(); ++k) r[k] = b[k] - r[k];
    const double reached = scaled_norm(system, r) / scale;
    if (!(reached < report.reduction) && i > 0) break;
    report.reduction = reached;
    std::ranges::copy(dx, x.begin());
  }
  report.ok = std::isfinite(report.reduction);
  if (!report.ok) report.reason = "MUMPS: the solution is not finite";
  if (report.ok && unsolvable(factor, report.reduction))
    report.ok = false, report.reason = "MUMPS: the matrix is singular";
  report.by_fallback = report.ok;
  return report;
}

int DirectFallback::negative_pivots(const CoupledSystem& system) {
  if (!system.problem().symmetric() || !available(system.problem())) return -1;
  Mumps mumps(system.problem().comm(),
              {.null_pivots = true, .memory_limit_mb = available_mb(system.problem().comm())});
  const FactorReport factor = factorise(system, mumps);
  return factor.ok ? factor.nonpositive() : -1;
}

}  // namespace bulbus::inline solve
