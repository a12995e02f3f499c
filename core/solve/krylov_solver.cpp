#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/inner_product.hpp"
#include "core/solve/direct_fallback.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline solve {
namespace {

// s A s. `work`: a vector to work with, which it may share with its preconditioner.
class Scaled final : public LinearOperator {
 public:
  Scaled(const CoupledOperator& A, std::span<double> work) : A_(A), work_(work) {}
  int size() const override { return A_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    const auto& s = A_.system().scaling();
    for (std::size_t i = 0; i < work_.size(); ++i) work_[i] = s[i] * x[i];
    A_.apply(work_, y);
    for (std::size_t i = 0; i < work_.size(); ++i) y[i] *= s[i];
  }

 private:
  const CoupledOperator& A_;
  std::span<double> work_;
};

// s⁻¹ M s⁻¹
class ScaledPreconditioner final : public Preconditioner {
 public:
  ScaledPreconditioner(const CoupledSystem& system, const Preconditioner& inner, std::span<double> work)
      : system_(system), inner_(inner), work_(work) {}
  int size() const override { return system_.size(); }
  bool is_linear() const override { return inner_.is_linear(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    const auto& s = system_.scaling();
    for (std::size_t i = 0; i < work_.size(); ++i) work_[i] = x[i] / s[i];
    inner_.apply(work_, y);
    for (std::size_t i = 0; i < work_.size(); ++i) y[i] /= s[i];
  }

 private:
  const CoupledSystem& system_;
  const Preconditioner& inner_;
  std::span<double> work_;
};

// Norms of b − A x on displacements (bodies included), element pressures and liquids.
std::array<double, 3> block_norms(const LinearOperator& A, const CoupledSystem& system,
                                  std::span<const double> b, std::span<const double> x) {
  std::vector<double> r(b.size());
  A.apply(x, r);
  const Layout& layout = system.layout();
  std::array<double, 3> sums{};
  for (int i = 0; i < layout.size(); ++i) {
    const int block = i < layout.primal() ? 0 : i < layout.primal() + layout.hexes ? 1 : 2;
    sums[block] += (b[i] - r[i]) * (b[i] - r[i]);
  }
  system.problem().comm().sum(sums);
  for (double& s : sums) s = std::sqrt(s);
  return sums;
}

// Krylov iterations that a digit costs where solves are easy. With fewer, solves that need the correction
// begin without it, and up to `pressures.after` iterations are made in vain; with more, easy ones pay for it.
constexpr double per_digit = 1.5;

// And where a small system is better left to MUMPS (docs/decisions/017).
constexpr double slow_per_digit = 10;

// Does it take more than `most` iterations, at the pace of the last many, until the residual is down to the
// tolerance?
bool stagnates(const std::vector<double>& residuals, double tolerance, int most) {
  constexpr std::size_t many = 60;  // docs/decisions/017
  const std::size_t done = residuals.size();
  if (done <= many) return false;
  const double per_iteration = std::log(residuals[done - 1 - many] / residuals.back()) / many;
  const double left = std::log(residuals.back() / tolerance);
  return !(left <= per_iteration * (most - static_cast<double>(done - 1)));
}

// xᵀ K x of displacements, K with its augmentation, over the sum of the magnitudes of the products that make
// it: from the right-hand side and the other unknowns, by the constraints' rows. Collective.
double curvature(const CoupledOperator& A, std::span<const double> b, std::span<const double> x) {
  const CoupledSystem& system = A.system();
  const Layout& layout = system.layout();
  std::array<double, 2> sums{};
  const auto add = [&](double term) { sums[0] += term, sums[1] += std::abs(term); };
  for (int i = 0; i < layout.primal(); ++i) add(x[i] * b[i]);
  for (int e = layout.primal(); e < layout.primal() + layout.hexes; ++e) add(-x[e] * b[e]);
  for (int i = 0; i < layout.liquids; ++i)
    if (system.problem().liquids()[i].enclosed())
      add(-A.column_part(i) * layout.pressures(x)[i] *
          (layout.pressures(b)[i] + system.compliance(i) * layout.pressures(x)[i]));
  system.problem().comm().sum(sums);
  return sums[1] > 0 ? sums[0] / sums[1] : 0;
}

// What two solves in a row did, the second from where the first had come to.
KrylovReport joined(KrylovReport first, KrylovReport then) {
  if (first.history.empty()) return then;
  then.initial = first.initial;
  then.iterations += first.iterations;
  then.basis_bytes = std::max(first.basis_bytes, then.basis_bytes);
  if (!then.history.empty())
    first.history.insert(first.history.end(), then.history.begin() + 1, then.history.end());
  then.history = std::move(first.history);
  return then;
}

class KrylovSolver final : public LinearSolver {
 public:
  KrylovSolver(const LinearSettings& settings, std::unique_ptr<PreconditionerFactory> factory,
               Profiler& profiler)
      : settings_(settings),
        factory_(std::move(factory)),
        profiler_(profiler),
        fallback_(settings, profiler) {}

  Preparation prepare(SharedSystem system) override {
    if (given_up_) return {.ok = true};
    const auto scope = profiler_.clock.measure("preconditioner set-up");
    preconditioner_.reset();
    preconditioner_ = factory_->make(system);
    profiler_.memory.set("preconditioner", preconditioner_->bytes());
    const std::string error = preconditioner_->setup_error();
    Preparation prepared{.ok = error.empty(),
                         .reason = error,
                         .augmentation = preconditioner_->augmentation(),
                         .factor = preconditioner_->factor()};
    if (prepared.ok || !fallback_.available(system->problem())) return prepared;
    give_up();
    prepared.ok = true;
    return prepared;
  }

  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    const CoupledSystem& system = A.system();
    if (given_up_) return fallback_.solve(A, b, x, tolerance);
    LinearReport r;
    {
      const auto scope = profiler_.clock.measure("linear solve");
      r = solve_by_krylov(A, b, x, tolerance);
    }
    r.retry = !r.ok && factory_->can_improve();
    if (r.retry)
      factory_->improve();
    else if (r.ok)
      factory_->record(r.iterations / -std::log10(tolerance));
    else
      factory_->forget();
    if (r.ok || r.retry || !fallback_.available(system.problem())) return r;
    LinearReport direct = fallback_.solve(A, b, x, tolerance);
    direct.iterations = r.iterations, direct.history = std::move(r.history),
    direct.blocks = std::move(r.blocks);
    if (!direct.ok)
      direct.reason = r.reason + "; " + direct.reason;
    else
      direct.reason = r.reason;
    if (direct.ok && fallback_.cheap(system.problem())) give_up();
    return direct;
  }

  void release() override {
    preconditioner_.reset();
    factory_->release();
  }
  void forget() override { factory_->forget(); }
  void increment_begins() override { slow_ = given_up_ = false; }
  void watch(SolveWatcher watcher) override { watcher_ = std::move(watcher); }
  bool counts_pivots(const Problem& problem) override {
    return problem.symmetric() && fallback_.cheap(problem);
  }
  int negative_pivots(const CoupledSystem& system) override { return fallback_.negative_pivots(system); }

 private:
  // The systems of this increment that are still to come are those of MUMPS.
  void give_up() {
    given_up_ = true;
    preconditioner_.reset();
    factory_->forget();
  }

  LinearReport solve_by_krylov(const CoupledOperator& unscaled, std::vector<double> b, std::span<double> x,
                               double tolerance) {
    const CoupledSystem& system = unscaled.system();
    const auto& s = system.scaling();
    for (std::size_t i = 0; i < b.size(); ++i) b[i] *= s[i];
    std::fill(x.begin(), x.end(), 0.0);
    std::vector<double> work(b.size());
    const Scaled A(unscaled, work);
    const ScaledPreconditioner M(system, *preconditioner_, work);
    std::vector<std::array<double, 3>> blocks;
    KrylovObserver observer;
    if (settings_.record_krylov)
      observer = [&](int, std::span<const double> iterate) {
        blocks.push_back(block_norms(A, system, b, iterate));
      };
    const KrylovReport k = solve_in_stages(A, M, b, x, tolerance, system, observer);
    profiler_.memory.set("Krylov basis", k.basis_bytes);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] *= s[i], b[i] /= s[i];
    LinearReport r{.ok = k.converged,
                   .reason = k.reason,
                   .iterations = k.iterations,
                   .reduction = k.initial > 0 ? k.final / k.initial : 0};
    r.history = k.history;
    r.blocks = std::move(blocks);
    if (r.ok) r.curvature = curvature(unscaled, b, x);
    if (settings_.record_spectrum) r.spectrum = preconditioner_->displacement_spectrum();
    if (!r.ok) r.reason = "GMRES: " + r.reason;
    return r;
  }

  // As it is, unless the solve before was slow or more digits are asked for than the iterations before the
  // correction can bring; then with the deferred component, too; where plain GMRES, which needs one basis
  // only, still fails, as near limit points, the flexible one, anew from where it has come to as long as
  // rounding ends it and each time gains a digit. Where there is another way, stagnation ends it all.
  KrylovReport solve_in_stages(const LinearOperator& A, const Preconditioner& M, std::span<const double> b,
                               std::span<double> x, double tolerance, const CoupledSystem& system,
                               const KrylovObserver& observer) {
    const Comm& comm = system.problem().comm();
    const double scale = norm(b, comm);
    const bool other_way = factory_->can_improve() || fallback_.available(system.problem());
    KrylovReport report;
    bool flexible = !M.is_linear() || tolerance < least_of_plain_method, stagnant = false, slow = false;
    // A system so small is factorised in less time; and a residual that falls so slowly says little of the
    // error.
    const bool cheap = fallback_.cheap(system.problem());
    const double enough = slow_per_digit * std::max(3., -std::log10(tolerance));  // a slow start is none yet
    std::vector<double> residuals;
    const auto goes_on = [&](int, double residual) {
      residuals.push_back(residual / scale);
      if (watcher_) watcher_({static_cast<int>(residuals.size()), residuals.back(), tolerance});
      slow = cheap && static_cast<double>(residuals.size()) >= enough;
      stagnant = other_way && residuals.back() > tolerance &&
                 (slow || stagnates(residuals, tolerance, settings_.max_iterations));
      return !stagnant;
    };
    const auto go_on = [&](int most) {
      if (report.converged || stagnant || most <= 0) return;
      const Precision basis = flexible ? Precision::full : Precision::single;
      const KrylovOptions options{tolerance, std::min(settings_.restart, most), most, flexible, basis,
                                  goes_on};
      report = joined(std::move(report), fgmres(A, &M, b, x, options, comm, observer));
    };
    const int before_correction = std::min(settings_.pressures.after, settings_.max_iterations);
    if (preconditioner_->has_deferred_component()) {
      if (!slow_ && -per_digit * std::log10(tolerance) <= before_correction) go_on(before_correction);
      if (!report.converged) enable_deferred_component(tolerance);
    }
    go_on(settings_.max_iterations - report.iterations);
    flexible = true;
    double before;
    do {
      before = report.final;
      go_on(settings_.max_iterations - report.iterations);
    } while (!report.converged && report.final < 0.1 * before);
    slow_ = report.iterations > before_correction;
    if (stagnant && !report.converged)
      report.reason = slow ? "the residual falls slowly" : "the residual stagnates";
    return report;
  }

  void enable_deferred_component(double tolerance) {
    preconditioner_->enable_deferred_component(tolerance);
    profiler_.memory.set("preconditioner", preconditioner_->bytes());
  }

  LinearSettings settings_;
  std::unique_ptr<PreconditionerFactory> factory_;
  Profiler& profiler_;
  DirectFallback fallback_;
  SolveWatcher watcher_;
  std::unique_ptr<CoupledPreconditioner> preconditioner_;
  bool given_up_ = false;  // until the next increment
  bool slow_ = false;      // was the solve before, of the same increment?
};

}  // namespace

std::unique_ptr<LinearSolver> make_krylov_solver(const LinearSettings& settings,
                                                 std::unique_ptr<PreconditionerFactory> factory,
                                                 Profiler& profiler) {
  return std::make_unique<KrylovSolver>(settings, std::move(factory), profiler);
}

}  // namespace bulbus::inline solve
