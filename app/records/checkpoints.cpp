#include "app/records/checkpoints.hpp"

#include <filesystem>
#include <utility>

#include "app/records/problem_mark.hpp"
#include "core/base/memory.hpp"
#include "core/io/checkpoint.hpp"

namespace bulbus {
namespace {

void serialize(Archive& archive, State& start, State& now) {
  for (auto [name, state] : {std::pair{"start", &start}, {"now", &now}}) {
    const Archive::Group group(archive, name);
    state->serialize(archive);
  }
}

void refuse_missing(const std::string& path, const Comm& comm) {
  if (comm.any(comm.rank() == 0 && !std::filesystem::exists(path)))
    throw input_error(path + ": there is no such checkpoint",
                      "Let a run write it (output.checkpoint), or run without --restart.");
}

}  // namespace

std::string checkpoint_in(const std::string& folder) { return folder + "/" + checkpoint_file; }

Checkpoint::Checkpoint(const std::string& path, const Scene& scene, const Prepared& prepared) {
  const Problem& problem = *prepared.problem;
  refuse_missing(path, problem.comm());
  kept_ = open_checkpoint(path, problem.mesh());
  ProblemMark mark;
  place_.serialize(*kept_);
  mark.serialize(*kept_);
  refuse_another(mark, mark_of(scene, prepared.inputs, problem, place_.step), prepared.inputs, path);
}

Resumed Checkpoint::resume(Problem& problem, Remembering& records) {
  Resumed r{place_, problem.initial_state(), problem.initial_state()};
  serialize(*kept_, r.start, r.state);
  problem.resume(place_.step, r.start, place_.done, r.state, *kept_);
  records.serialize(*kept_, place_);
  return r;
}

void Checkpoints::step_begins(const State& start) { start_ = start; }

void Checkpoints::rests(MarchPlace place, State& state, bool last) {
  const int number = place.report.increments;
  if (every_ == 0 || number == 0 || number == written_ || !(last || number % every_ == 0)) return;
  write(place, state);
  written_ = number;
}

void Checkpoints::interrupted(MarchPlace place, State& state) {
  if (written_ == place.report.increments) return;
  write(place, state);
  written_ = place.report.increments;
}

void Checkpoints::resumed(const Resumed& from) {
  written_ = from.place.report.increments;
  step_begins(from.start);
}

std::size_t Checkpoints::bytes() const { return bytes_of(start_.x) + bytes_of(start_.lambda); }

void Checkpoints::write(MarchPlace& place, State& state) {
  ProblemMark mark = mark_of(scene_, inputs_, problem_, place.step);
  folder_.claim({checkpoint_file});
  write_checkpoint(checkpoint_in(folder_.path()), problem_.mesh(), [&](Archive& archive) {
    place.serialize(archive);
    mark.serialize(archive);
    serialize(archive, start_, state);
    problem_.serialize(archive);
    records_.serialize(archive, place);
  });
}

}  // namespace bulbus
