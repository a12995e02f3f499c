#pragma once
#include <nlohmann/json_fwd.hpp>

#include "app/memory/sizes.hpp"
#include "app/records/recorder.hpp"

namespace bulbus::inline app {

/// The final figures of a run as summary.json holds them. Collective; the same on every rank.
nlohmann::json summary_of(const std::string& title, const Prepared& prepared, const Recorder& recorder,
                          const MarchReport& march, const Profiler& profiler, double seconds);

/// Compiler, build and libraries: name and version.
std::vector<std::pair<std::string, std::string>> versions();

}  // namespace bulbus::inline app
