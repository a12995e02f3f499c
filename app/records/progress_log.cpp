#include "app/records/progress_log.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/memory/sizes.hpp"
#include "app/records/log_columns.hpp"

namespace bulbus::inline app {
namespace {

constexpr double worth_telling = 10;  // seconds to go

}  // namespace

std::string duration(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const long long s = std::llround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

ProgressLog::ProgressLog(const Log& log, const Problem& problem, const SteppingSettings& stepping,
                         double silence)
    : log_(log),
      model_(problem.model()),
      stable_pivots_(stable_pivots(problem)),
      forecast_(stepping),
      silence_(silence) {}

void ProgressLog::resumes(const MarchProgress& place) {
  log_.info("");
  log_.info(fmt::format("goes on after increment {}: {:.4g} of step {} of {} is done",
                        place.report.increments, place.done, place.step + 1, model_.steps.size()));
}

void ProgressLog::step_begins(int step, const StepSpec& spec, const State&) {
  log_.info("");
  log_.info(fmt::format("step {} of {}{}: {} increment{}", step + 1, model_.steps.size(),
                        spec.name.empty() ? "" : " '" + spec.name + "'", spec.increments,
                        spec.increments == 1 ? "" : "s"));
}

void ProgressLog::increment_begins(int step, double from, double to) {
  log_.info(fmt::format("  from {:.4g} to {:.4g} of the step", from, to));
  log_.info(header_of(newton_table()));
  told_ = Clock::now();
  place_ = fmt::format("step {} of {}, {:.4g} to {:.4g}: ", step + 1, model_.steps.size(), from, to);
  show("Newton iteration 0");
}

void ProgressLog::show(const std::string& done) const {
  if (log_.wants_progress()) log_.progress(place_ + done + ", " + duration(elapsed()));
}

void ProgressLog::newton_iteration(const NewtonIteration& i) {
  std::string line = fmt::format("    {:>3}  {:.2e}  {:.2e}  {:.2e}", i.number, i.error.force, i.error.volume,
                                 i.error.liquid);
  if (i.step > 0 || i.linear.ok)
    line += fmt::format("  {:.1e}  {:>6}  {:.1e}  {:<6.3g}  {}", i.tolerance, i.linear.iterations,
                        i.linear.reduction, i.step, duration(elapsed()));
  if (i.linear.negative_pivots >= 0) line += fmt::format("  {} negative pivots", i.linear.negative_pivots);
  if (i.linear.by_fallback)
    line += "  by MUMPS" + (i.linear.reason.empty() ? "" : " (" + i.linear.reason + ")");
  if (!i.error.region.empty()) line += "  (" + i.error.region + ")";
  log_.info(line);
  details(i);
  told_ = Clock::now();
  show(fmt::format("Newton iteration {}", i.number + 1));
}

void ProgressLog::details(const NewtonIteration& i) const {
  const LinearReport& l = i.linear;
  if (i.prescribed > 0)
    log_.detail(fmt::format("         prescribed increment still to be made: {:.3g} mm", i.prescribed));
  if (l.curvature != 0)
    log_.detail(fmt::format("         curvature of the Newton step: {:.2e}", l.curvature));
  if (l.spectrum[1] != 0)
    log_.detail(fmt::format("         eigenvalues of the preconditioned displacement block: {:.3g} to {:.3g}",
                            l.spectrum[0], l.spectrum[1]));
  if (l.factor)
    log_.detail(fmt::format(
        "         factors: {:.3g} entries of {:.3g} in the matrix, {:.2e} operations, {:.0f} MB, {}",
        l.factor->factor_entries, l.factor->matrix_entries, l.factor->flops, l.factor->memory_mb,
        l.factor->ordering));
  if (!l.ok && !l.reason.empty()) log_.detail("         linear solve: " + l.reason);
}

bool ProgressLog::unstable(const NewtonReport& report) const {
  return report.negative_curvature ||
         (report.negative_pivots >= 0 && report.negative_pivots != stable_pivots_);
}

void ProgressLog::solve_lasts(const SolveProgress& p) {
  log_.detail(
      fmt::format("         Krylov {:>4}  residual {:.2e} of {:.1e}", p.iteration, p.residual, p.tolerance));
  if (log_.wants_progress())
    show(fmt::format("linear solve, {} Krylov iterations, residual {:.1e} of {:.1e}", p.iteration, p.residual,
                     p.tolerance));
  const double now = Clock::now();
  if (now - told_ < silence_) return;
  told_ = now;
  log_.info(fmt::format("         linear solve: {} Krylov iterations, residual {:.1e} of {:.1e}  {}",
                        p.iteration, p.residual, p.tolerance, duration(elapsed())));
}

void ProgressLog::increment_cut(const NewtonReport& report, double from, double to) {
  log_.info(fmt::format("  cut: {:.4g} to {:.4g} did not converge after {} iterations: {}", from, to,
                        report.iterations.size(), report.reason));
}

std::string snap_sentence(const Increment& i) {
  return fmt::format(
      "the surfaces snap in step '{}': from {:.4g} of its way on no equilibrium was found near by, and the "
      "next one is that of {:.4g}. The tissue passes such a point dynamically: judge the figures after it "
      "with care.",
      i.step_name, i.start, i.progress);
}

void ProgressLog::increment_done(const Increment& i, const State&) {
  const double left = forecast_.after(i, model_.steps, Clock::now() - since_);
  since_ = Clock::now();
  log_.info(fmt::format("  increment {} converged: {} Newton and {} Krylov iterations in {}{}", i.number,
                        i.newton.iterations.size(), i.newton.krylov_iterations, duration(i.seconds),
                        left < worth_telling ? "" : "; about " + duration(left) + " to go"));
  if (i.leap) log_.warn(snap_sentence(i));
  const long long surplus = i.newton.negative_pivots - stable_pivots_;
  if (i.newton.negative_pivots >= 0 && surplus != 0)
    log_.warn(fmt::format(
        "not a stable equilibrium: {} negative pivot(s) more than one has. The body would leave it at the "
        "least push; prescribe the motion that is missing, or judge the figures with care.",
        surplus));
  if (i.newton.negative_curvature)
    log_.warn(
        "perhaps not a stable equilibrium: the last Newton step has negative curvature. Compare with "
        "solver.linear.method: direct, "
        "which counts the negative pivots.");
}

void ProgressLog::contacts(const std::vector<Interactions::Contact>& contacts,
                           const std::vector<ContactStanding>& standings) {
  for (std::size_t k = 0; k < contacts.size(); ++k)
    log_.info(fmt::format("    contact {}: {} nodes touch, largest penetration {:.3g} mm",
                          contacts[k].spec.name, standings[k].touching, standings[k].penetration));
}

void ProgressLog::probes(const ProbeSet& probes, const ProbeValues& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i])
      log_.info(fmt::format("    {:<28} {:>14.6g} {}", probes.name(i), *values[i], probes.unit(i)));
}

}  // namespace bulbus::inline app
