#pragma once
#include <nlohmann/json.hpp>
#include <optional>

#include "app/records/history.hpp"
#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// What a run left in its folder, as far as it is there.
struct RunRecord {
  struct Frame {
    int increment = 0;  ///< of the names of its files
    double time = 0;
    std::string label;  ///< "buckle, 50 %"
  };
  std::string folder;
  nlohmann::json summary;      ///< an object; empty where there is no summary.json
  History history;             ///< empty where there is no history.csv
  std::optional<Scene> scene;  ///< none where resolved.yaml is missing or of another version
  std::string scene_text, log_text;
  std::vector<Frame> frames;  ///< saved states in the order of their times

  std::string title() const;
  /// The spec of a probe; null if it is not known.
  const ProbeSpec* probe(const std::string& name) const;
  std::string unit(const std::string& probe) const;
};

/// Throws InputError if the folder has no records of a run. Not collective.
RunRecord read_run(const std::string& folder);

}  // namespace bulbus::inline app
