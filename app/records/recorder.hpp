#pragma once
#include <optional>

#include "app/prepare.hpp"
#include "app/records/checkpoints.hpp"
#include "app/records/progress_log.hpp"
#include "app/records/result_files.hpp"
#include "app/records/witness.hpp"
#include "core/io/table.hpp"

namespace bulbus::inline app {

/// What a step took, failed attempts included.
struct StepRecord {
  std::string name;
  int increments = 0, newton_iterations = 0, krylov_iterations = 0, cuts = 0;
  double seconds = 0;
};

/// Writes the records of a march as it goes: log, history.csv, krylov.csv, result files. Disk faults are
/// OutputErrors, at the latest at the end of the increment. All members that take a state are collective.
class Recorder final : public MarchObserver, public Archived {
 public:
  Recorder(const Prepared& prepared, const Scene& scene, ResultsFolder& folder, const Log& log,
           Profiler& profiler, FileStart start = FileStart::anew);

  void step_begins(int step, const StepSpec& spec, const State& start) override;
  void step_begun(int step, const State& start) override;
  void increment_begins(int step, double from, double to) override;
  void newton_iteration(const NewtonIteration& iteration) override;
  void increment_cut(const NewtonReport& report, double from, double to) override;
  void increment_done(const Increment& increment, const State& state) override;
  void solve_lasts(const SolveProgress& progress) { progress_.solve_lasts(progress); }
  void rests(const MarchProgress& place, State& state, bool last) override;
  void interrupted(const MarchProgress& place, State& state) override;
  void step_refused() override;
  /// After the march, with the state it ended in.
  void finish(const State& state);
  void serialize(Archive& archive, const MarchProgress& place) override;
  /// Goes on as the records of a run that was left. Collective.
  Resumed resume(Checkpoint& checkpoint);

  const ProbeSet& probes() const { return probes_; }
  /// Of the last state recorded.
  const ProbeValues& values() const { return values_; }
  /// The same, in the order of the contacts.
  const std::vector<ContactStanding>& contacts() const { return contacts_; }
  /// After a march that did not converge: its cause as far as it is known, and what to try. Collective.
  std::string diagnosis(const State& last) const;
  const std::vector<StepRecord>& steps() const { return steps_; }
  /// At the end of the first step, of a node from where it is drawn, mm; of a run with an unloaded reference.
  const std::optional<double>& from_drawn() const { return from_drawn_; }
  /// Converged so far.
  int increments() const { return increments_; }
  /// Of the last factorisation; -1 if there was none of a symmetric matrix.
  int negative_pivots() const { return negative_pivots_; }
  /// Linear systems that MUMPS solved in place of GMRES.
  int direct_solves() const { return direct_solves_; }
  /// Converged increments whose equilibrium is not stable, as far as pivots or curvature tell.
  int unstable_increments() const { return unstable_increments_; }
  /// A sentence for every increment so far that has leapt.
  std::vector<std::string> snaps() const;
  /// Of the direct solver's last factorisation, and the largest residual that its solutions left, ‖s r‖ / ‖s
  /// b‖.
  const std::optional<FactorReport>& factor() const { return factor_; }
  double worst_reduction() const { return worst_reduction_; }

 private:
  void count(const NewtonReport& report);
  void take(Snapshot& snapshot);
  void append_history(const Increment& increment);
  void append_krylov(const NewtonIteration& iteration);

  Problem& problem_;
  const Log& log_;
  std::shared_ptr<const Interactions> interactions_;
  Profiler& profiler_;
  ProgressLog progress_;
  Witness witness_;
  std::string snaps_;  // a line for each
  ProbeSet probes_;
  ProbeRecord record_;
  ResultFiles results_;
  Checkpoints checkpoints_;
  std::optional<CsvTable> history_, krylov_;  // on rank 0
  std::string fault_;                         // of krylov_, on rank 0
  ProbeValues values_;
  std::vector<ContactStanding> contacts_;
  std::vector<StepRecord> steps_;
  int increments_ = 0, cuts_ = 0, negative_pivots_ = -1, direct_solves_ = 0, unstable_increments_ = 0;
  std::optional<FactorReport> factor_;
  std::optional<double> from_drawn_;
  double worst_reduction_ = 0;
  bool taken_ = false;  // are the values of the last state?
  bool direct_;         // is the linear solver?
  double since_ = Clock::now();
};

}  // namespace bulbus::inline app
