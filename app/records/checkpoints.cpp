#include "app/records/checkpoints.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "app/records/problem_mark.hpp"
#include "core/base/memory.hpp"
#include "core/io/checkpoint.hpp"

namespace bulbus::inline app {
namespace {

using NamedStates = std::vector<std::pair<const char*, State*>>;

void serialize_states(Archive& archive, const NamedStates& states) {
  for (const auto& [name, state] : states) {
    const Archive::Group group(archive, name);
    state->serialize(archive);
  }
}

void serialize_reference(Archive& archive, std::vector<double>& unloaded, UnloadedReport& r) {
  const Archive::Group group(archive, "reference");
  archive.nodes("X", unloaded);
  archive.scalars("report", r.found, r.iterations, r.krylov_iterations, r.divisions, r.distance, r.way,
                  r.negative_pivots, r.seconds);
  if (!archive.reading() || archive.knows("curvature")) archive.scalars("curvature", r.curvature);
  if (!r.loaded || (archive.reading() && !archive.knows("loaded"))) return;
  const Archive::Group loaded(archive, "loaded");
  r.loaded->serialize(archive);
}

// `previous` exists between two increments of a step alone.
NamedStates states_of(MarchProgress& place, State& start, State& now) {
  NamedStates states{{"start", &start}, {"now", &now}};
  if (place.last > 0) states.emplace_back("previous", &place.previous);
  return states;
}

void refuse_missing(const std::string& path, const Comm& comm) {
  if (comm.any(comm.rank() == 0 && !std::filesystem::exists(path)))
    throw input_error(path + ": there is no such checkpoint",
                      "Let a run write it (output.checkpoint), or run without --restart.");
}

}  // namespace

std::string checkpoint_in(const std::string& folder) { return folder + "/" + checkpoint_file; }

Checkpoint::Checkpoint(const std::string& path, const Scene& scene, const Prepared& prepared) : path_(path) {
  const Problem& problem = *prepared.problem;
  refuse_missing(path, problem.comm());
  kept_ = open_checkpoint(path, problem.mesh());
  ProblemMark mark;
  place_.serialize(*kept_);
  mark.serialize(*kept_);
  refuse_another(mark, mark_of(scene, prepared.inputs, problem, place_.step), prepared.inputs, path);
  if (!scene.reference) return;
  unloaded_ = problem.mesh().X;
  reference_.loaded = std::make_shared<State>(problem.initial_state());
  serialize_reference(*kept_, unloaded_, reference_);
}

Resumed Checkpoint::resume(Problem& problem, Archived& records) {
  Resumed r{place_, problem.initial_state(), problem.initial_state()};
  if (place_.last > 0) r.place.previous = problem.initial_state();
  serialize_states(*kept_, states_of(r.place, r.start, r.state));
  problem.resume(place_.step, r.start, place_.done, r.state, *kept_);
  records.serialize(*kept_, place_);
  return r;
}

void Checkpoints::step_begins(const State& start) { start_ = start; }

void Checkpoints::rests(const MarchProgress& place, State& state, bool last) {
  const int number = place.report.increments;
  if (every_ > 0 && number > 0 && (last || number % every_ == 0)) return interrupted(place, state);
  if (place.done == 1 && !last) serialize(step_end_.emplace(problem_.mesh()), place, state);
}

void Checkpoints::interrupted(const MarchProgress& place, State& state) {
  if (written_ == place.report.increments) return;
  write([&](Archive& archive) { serialize(archive, place, state); });
  written_ = place.report.increments;
}

void Checkpoints::step_refused() {
  if (step_end_) write([&](Archive& archive) { step_end_->give(archive); });
}

void Checkpoints::resumed(Resumed& from, const std::string& path) {
  std::error_code none;  // of a file that is not there
  const Comm& comm = problem_.comm();
  if (comm.any(comm.rank() == 0 && std::filesystem::equivalent(path, checkpoint_in(folder_.path()), none)))
    written_ = from.place.report.increments;
  step_begins(from.start);
  if (written_ < 0 && from.place.done == 1)
    serialize(step_end_.emplace(problem_.mesh()), from.place, from.state);
}

std::size_t Checkpoints::bytes() const { return bytes_of(start_.x) + bytes_of(start_.lambda); }

void Checkpoints::write(const std::function<void(Archive&)>& serialize) {
  folder_.claim({checkpoint_file});
  write_checkpoint(checkpoint_in(folder_.path()), problem_.mesh(), serialize);
}

void Checkpoints::serialize(Archive& archive, MarchProgress place, State& state) {
  ProblemMark mark = mark_of(scene_, inputs_, problem_, place.step);
  place.serialize(archive);
  mark.serialize(archive);
  if (reference_) {
    auto unloaded = problem_.mesh().X;
    if (place.report.increments > 0) reference_->loaded.reset();  // it has been made use of
    serialize_reference(archive, unloaded, *reference_);
  }
  serialize_states(archive, states_of(place, start_, state));
  problem_.serialize(archive);
  records_.serialize(archive, place);
}

}  // namespace bulbus::inline app
