#include "app/records/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/memory/sizes.hpp"
#include "app/records/probe_kinds.hpp"
#include "core/io/json_file.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {
namespace {

std::vector<std::string> history_columns(const ProbeSet& probes) {
  std::vector<std::string> columns{"increment", "step", "time"};
  for (std::size_t i = 0; i < probes.size(); ++i) columns.push_back(probes.name(i));
  for (const char* c : {"newton_iterations", "krylov_iterations", "cuts", "seconds"}) columns.emplace_back(c);
  return columns;
}

// Of the columns that have one.
nlohmann::json history_units(const ProbeSet& probes) {
  nlohmann::json units{{"seconds", "s"}};
  for (std::size_t i = 0; i < probes.size(); ++i)
    if (!probes.unit(i).empty()) units[probes.name(i)] = probes.unit(i);
  return units;
}

std::vector<std::string> krylov_columns() {
  return {"increment",        "newton",          "iteration",           "residual",          "displacement",
          "element_pressure", "liquid_pressure", "smallest_eigenvalue", "largest_eigenvalue"};
}

}  // namespace

Recorder::Recorder(const Prepared& prepared, const Scene& scene, ResultsFolder& folder, const Log& log,
                   Profiler& profiler, FileStart start)
    : problem_(*prepared.problem),
      log_(log),
      interactions_(prepared.interactions),
      profiler_(profiler),
      progress_(log, problem_, scene.solver.stepping),
      witness_(problem_, static_cast<int>(stable_pivots(problem_))),
      probes_(problem_, probe_kinds(interactions_)),
      record_(probes_),
      results_(scene.output, problem_, interactions_, folder),
      checkpoints_(scene, prepared, *this, folder),
      direct_(scene.solver.linear.method == Method::direct) {
  values_.resize(probes_.size());
  const bool krylov = scene.solver.linear.record_krylov || scene.solver.linear.record_spectrum;
  folder.claim({history_file, units_file});
  if (krylov) folder.claim({krylov_file});
  write_together(problem_.comm(), [&] {
    if (problem_.comm().rank() != 0) return;
    write_json(folder.path() + "/" + units_file, history_units(probes_));
    history_.emplace(folder.path() + "/" + history_file, history_columns(probes_), start);
    if (krylov) krylov_.emplace(folder.path() + "/" + krylov_file, krylov_columns(), start);
  });
}

void Recorder::step_begins(int step, const StepSpec& spec, const State& start) {
  steps_.push_back({.name = spec.name});
  progress_.step_begins(step, spec, start);
  witness_.step_begins(step, start);
  checkpoints_.step_begins(start);
  profiler_.memory.set("checkpoints", checkpoints_.bytes());
}

void Recorder::step_begun(int step, const State& start) {
  checkpoints_.step_begun();
  if (step > 0) return;
  const auto scope = profiler_.clock.measure("records");
  Snapshot snapshot(problem_, start);
  results_.begin(snapshot);
}

void Recorder::increment_begins(int step, double from, double to) {
  since_ = Clock::now();
  progress_.increment_begins(step, from, to);
}

void Recorder::newton_iteration(const NewtonIteration& i) {
  progress_.newton_iteration(i);
  if (i.linear.factor) {
    factor_ = i.linear.factor;
    worst_reduction_ = std::max(worst_reduction_, i.linear.reduction);
  }
  if (!krylov_ || !fault_.empty()) return;
  try {
    append_krylov(i);
  } catch (const std::runtime_error& e) {
    fault_ = e.what();  // the other ranks hear of it when the increment is done
  }
}

void Recorder::append_krylov(const NewtonIteration& i) {
  for (std::size_t k = 0; k < i.linear.history.size(); ++k) {
    std::vector<CsvTable::Cell> row{static_cast<long long>(increments_ + 1), static_cast<long long>(i.number),
                                    static_cast<long long>(k), i.linear.history[k]};
    const bool known = k < i.linear.blocks.size();
    for (int block = 0; block < 3; ++block)
      row.push_back(known ? CsvTable::Cell(i.linear.blocks[k][block]) : CsvTable::Cell(std::string()));
    for (double e : i.linear.spectrum) row.emplace_back(e);
    krylov_->append(row);
  }
}

void Recorder::count(const NewtonReport& report) {
  StepRecord& step = steps_.back();
  step.newton_iterations += static_cast<int>(report.iterations.size());
  step.krylov_iterations += report.krylov_iterations;
  step.seconds += Clock::now() - since_;
  if (report.negative_pivots >= 0 || report.krylov_iterations > 0) negative_pivots_ = report.negative_pivots;
  direct_solves_ += report.direct_solves;
}

void Recorder::increment_cut(const NewtonReport& report, double from, double to) {
  count(report);
  ++steps_.back().cuts;
  ++cuts_;
  progress_.increment_cut(report, from, to);
  witness_.increment_cut(report);
}

void Recorder::increment_done(const Increment& increment, const State& state) {
  const auto scope = profiler_.clock.measure("records");
  count(increment.newton);
  ++steps_.back().increments;
  unstable_increments_ += progress_.unstable(increment.newton);
  if (increment.leap) snaps_ += snap_sentence(increment) + "\n";
  increments_ = increment.number;
  witness_.increment_done(increment, state);
  Snapshot snapshot(problem_, state);
  if (increment.progress == 1) record_.step_ended(increment.step, snapshot);
  take(snapshot);
  progress_.increment_done(increment, state);
  progress_.contacts(interactions_->contacts(), contacts_);
  progress_.probes(probes_, values_);
  if (const LocalMesh& mesh = problem_.mesh();
      !mesh.drawn.empty() && increment.step == 0 && increment.progress == 1) {
    from_drawn_ = largest_distance(mesh, state.x, mesh.drawn);
    log_.info(fmt::format("    {:.2e} mm from the drawn positions at most", *from_drawn_));
  }
  write_together(problem_.comm(), [&] {
    if (history_) append_history(increment);
    if (!fault_.empty()) throw std::runtime_error(fault_);
    log_.require_written();
  });
  results_.increment_done(increment.number, increment.time, snapshot);
}

void Recorder::rests(const MarchProgress& place, State& state, bool last) {
  const auto scope = profiler_.clock.measure("checkpoints");
  checkpoints_.rests(place, state, last);
}

void Recorder::interrupted(const MarchProgress& place, State& state) {
  const auto scope = profiler_.clock.measure("checkpoints");
  checkpoints_.interrupted(place, state);
}

void Recorder::step_refused() {
  const auto scope = profiler_.clock.measure("checkpoints");
  checkpoints_.step_refused();
}

void Recorder::serialize(Archive& archive, const MarchProgress& place) {
  archive.scalars("counts", increments_, cuts_, negative_pivots_);
  if (!archive.reading() || archive.knows("linear solver"))
    archive.scalars("linear solver", direct_solves_, unstable_increments_);
  if (!archive.reading() || archive.knows("snaps")) archive.text("snaps", snaps_);
  if (archive.reading() ? archive.knows("from drawn") : from_drawn_.has_value())
    archive.scalars("from drawn", from_drawn_ ? *from_drawn_ : from_drawn_.emplace());
  steps_.resize(place.step + 1);
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    StepRecord& s = steps_[k];
    s.name = problem_.model().steps[k].name;
    archive.scalars("step " + std::to_string(k), s.increments, s.newton_iterations, s.krylov_iterations,
                    s.cuts, s.seconds);
  }
  record_.serialize(archive, place.step + (place.done == 1));
  results_.serialize(archive, problem_.comm());
}

Resumed Recorder::resume(Checkpoint& checkpoint) {
  Resumed from = checkpoint.resume(problem_, *this);
  checkpoints_.resumed(from, checkpoint.path());
  progress_.resumes(from.place);
  if (from.place.begun) witness_.step_begins(from.place.step, from.start);
  if (from.place.report.increments > 0) {  // while the problem is in that state
    Snapshot snapshot(problem_, from.state);
    take(snapshot);
  }
  return from;
}

std::string Recorder::diagnosis(const State& last) const {
  const bool touching =
      std::ranges::any_of(contacts_, [](const ContactStanding& c) { return c.touching > 0; });
  FailureFacts facts = witness_.facts(last, touching);
  facts.direct = direct_;
  return bulbus::diagnosis(facts);
}

std::vector<std::string> Recorder::snaps() const {
  std::istringstream in(snaps_);
  std::vector<std::string> sentences;
  for (std::string line; std::getline(in, line);) sentences.push_back(line);
  return sentences;
}

void Recorder::take(Snapshot& snapshot) {
  taken_ = true;
  values_ = record_.increment_ended(snapshot);
  contacts_.clear();
  for (const Interactions::Contact& contact : interactions_->contacts())
    contacts_.push_back(standing(contact, snapshot));
}

void Recorder::append_history(const Increment& i) {
  std::vector<CsvTable::Cell> row{static_cast<long long>(i.number), i.step_name, i.time};
  for (const auto& value : values_)
    row.push_back(value ? CsvTable::Cell(*value) : CsvTable::Cell(std::string()));
  row.emplace_back(static_cast<long long>(i.newton.iterations.size()));
  row.emplace_back(static_cast<long long>(i.newton.krylov_iterations));
  row.emplace_back(static_cast<long long>(cuts_));
  row.emplace_back(i.seconds);
  history_->append(row);
}

void Recorder::finish(const State& state) {
  const auto scope = profiler_.clock.measure("records");
  Snapshot snapshot(problem_, state);
  if (!taken_) take(snapshot);
  results_.finish(snapshot);
}

}  // namespace bulbus::inline app
