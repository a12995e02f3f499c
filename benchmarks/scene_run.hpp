#pragma once
#include "benchmarks/common.hpp"

namespace bulbus::bench {

/// A scene as a user runs it.
struct SceneRun {
  std::string scene;             ///< path of the file
  std::vector<std::string> set;  ///< key=value
  unsigned timeout = 900;        ///< processor seconds
};

/// Path of one of data/scenes.
std::string scene_file(const std::string& name);

/// `bulbus run` as a process of its own, on this program's threads: its totals, seconds, memory and probes,
/// with the largest magnitude that every probe had ("scales"); processor time and peak are what the system
/// counted. "reason" where it did not finish.
json run_scene(const SceneRun& run);

/// Every probe of two runs under their names, the largest difference first; "relative" to the largest
/// magnitude it had in either run. Empty if one of them did not converge.
json compared_probes(const json& a, const std::string& name_a, const json& b, const std::string& name_b);

}  // namespace bulbus::bench
