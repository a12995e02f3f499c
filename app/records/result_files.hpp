#pragma once
#include <string>

#include "app/records/body_files.hpp"
#include "app/records/folder.hpp"
#include "app/records/line_files.hpp"
#include "app/scene/scene.hpp"
#include "core/io/series.hpp"
#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus::inline app {

/// result_0001.hdf and so on with their series, the rigid bodies, bars and sutures: the state before any
/// load as number 0, each n-th converged increment, and the last.
class ResultFiles {
 public:
  ResultFiles(const OutputSettings& settings, const Problem& problem,
              std::shared_ptr<const Interactions> interactions, ResultsFolder& folder);

  /// Saves the state before the first step, once. Collective. Throws std::runtime_error.
  void begin(Snapshot& snapshot);
  /// Saves if it is this increment's turn. Collective. Throws std::runtime_error.
  void increment_done(int number, double time, Snapshot& snapshot);
  /// Saves the state of the last increment unless that is done. Collective. Throws std::runtime_error.
  void finish(Snapshot& snapshot);
  /// Which increments have their files, and when they were. Collective.
  void serialize(Archive& archive, const Comm& comm);

 private:
  void save(Snapshot& snapshot);
  void claim(const std::string& result, const std::string& bodies, const std::string& lines);
  void list(int number, double time);

  OutputSettings settings_;
  std::shared_ptr<const Interactions> interactions_;
  ResultsFolder& folder_;
  Series series_;
  BodyFiles bodies_;
  LineFiles lines_;
  int last_ = 0;
  double time_ = 0;
  std::vector<double> saved_;  // number and time of each
};

}  // namespace bulbus::inline app
