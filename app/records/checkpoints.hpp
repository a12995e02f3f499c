#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "app/prepare.hpp"
#include "app/records/folder.hpp"
#include "app/scene/scene.hpp"
#include "core/io/archive_copy.hpp"
#include "core/problem/problem.hpp"
#include "core/solve/march.hpp"

namespace bulbus::inline app {

/// What a run keeps besides state and problem.
class Archived {
 public:
  virtual ~Archived() = default;
  /// At this place of the march. Collective.
  virtual void serialize(Archive& archive, const MarchProgress& place) = 0;
};

/// Where a run goes on.
struct Resumed {
  MarchProgress place;
  State start, state;  ///< of the step, and now
};

/// The file of a run's folder.
std::string checkpoint_in(const std::string& folder);

/// A checkpoint that may be gone on from.
class Checkpoint {
 public:
  /// Throws InputError if it is damaged, or of another problem. Collective.
  Checkpoint(const std::string& path, const Scene& scene, const Prepared& prepared);
  const MarchProgress& place() const { return place_; }
  const std::string& path() const { return path_; }
  /// Reference positions of the finest mesh, 3 per local node, of a scene with a reference, and how they were
  /// found.
  const std::vector<double>& unloaded() const { return unloaded_; }
  const UnloadedReport& reference() const { return reference_; }
  /// Brings problem and records, both new, to where they were. Collective.
  Resumed resume(Problem& problem, Archived& records);

 private:
  std::string path_;
  std::unique_ptr<Archive> kept_;
  MarchProgress place_;
  std::vector<double> unloaded_;
  UnloadedReport reference_;
};

/// Writes checkpoint.h5: each n-th converged increment and the last, and wherever the run is interrupted or
/// the scene turns out to be wrong.
class Checkpoints {
 public:
  Checkpoints(const Scene& scene, const Prepared& prepared, Archived& records, ResultsFolder& folder)
      : scene_(scene),
        inputs_(prepared.inputs),
        reference_(prepared.reference),
        problem_(*prepared.problem),
        records_(records),
        folder_(folder),
        every_(scene.output.checkpoint) {}

  /// Keeps where a step begins.
  void step_begins(const State& start);
  /// Writes if it is this increment's turn, or the last chance. Collective. Throws std::runtime_error.
  void rests(const MarchProgress& place, State& state, bool last);
  /// Writes unless this state is written. Collective. Throws std::runtime_error.
  void interrupted(const MarchProgress& place, State& state);
  /// After the end of a step: the next one has begun, or the scene is wrong and it cannot; then the end of
  /// the one before is written unless it is. Collective. Throws std::runtime_error.
  void step_begun() { step_end_.reset(); }
  void step_refused();
  /// The run goes on from a checkpoint, of this folder or another. Collective.
  void resumed(Resumed& from, const std::string& path);
  std::size_t bytes() const;

 private:
  void write(const std::function<void(Archive&)>& serialize);
  void serialize(Archive& archive, MarchProgress place, State& state);

  const Scene& scene_;
  std::vector<InputFile> inputs_;
  std::optional<UnloadedReport> reference_;
  Problem& problem_;
  Archived& records_;
  ResultsFolder& folder_;
  int every_, written_ = -1;
  State start_;
  std::optional<ArchiveCopy> step_end_;  // a step that cannot begin may have changed the problem
};

}  // namespace bulbus::inline app
