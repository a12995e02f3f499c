#pragma once
#include "app/records/forecast.hpp"
#include "contact/interaction_figures.hpp"
#include "core/io/log.hpp"
#include "core/problem/probes/probe_record.hpp"
#include "core/solve/march.hpp"

namespace bulbus::inline app {

/// Tells the march in lines that stand by themselves, on a screen as in a file: steps, increments, one line
/// per Newton iteration, cuts with their reason, and how long the rest may take; on a terminal, between
/// these, in a line that is written anew, how far the iteration has come.
class ProgressLog final : public MarchObserver {
 public:
  /// `silence`: seconds of a linear solve without a line.
  ProgressLog(const Log& log, const Problem& problem, const SteppingSettings& stepping, double silence = 10);

  void step_begins(int step, const StepSpec& spec, const State& state) override;
  void resumes(const MarchProgress& place);
  void increment_begins(int step, double from, double to) override;
  void newton_iteration(const NewtonIteration& i) override;
  void increment_cut(const NewtonReport& report, double from, double to) override;
  void increment_done(const Increment& increment, const State& state) override;
  /// Do pivots or curvature say that an equilibrium is not stable?
  bool unstable(const NewtonReport& report) const;
  /// After a Krylov iteration: a detail, and a line if none has been written for a while.
  void solve_lasts(const SolveProgress& progress);
  void contacts(const std::vector<Interactions::Contact>& contacts,
                const std::vector<ContactStanding>& standings);
  void probes(const ProbeSet& probes, const ProbeValues& values);

 private:
  double elapsed() const { return Clock::now() - start_; }
  void show(const std::string& done) const;
  void details(const NewtonIteration& i) const;

  const Log& log_;
  const Model& model_;
  long long stable_pivots_;
  Forecast forecast_;
  double silence_;
  double start_ = Clock::now(), since_ = start_;  // of the run, of the increment with its failed attempts
  double told_ = start_;                          // of the last line while increments are at work
  std::string place_;                             // step and increment, for the line of progress
};

/// What is told of an increment that has leapt over states without an equilibrium near by.
std::string snap_sentence(const Increment& leap);

/// "12 s", "4 min 10 s", "2 h 05 min".
std::string duration(double seconds);

}  // namespace bulbus::inline app
