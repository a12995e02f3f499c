#pragma once
#include <string>

#include "app/report/run_record.hpp"

/// Sections of a run's page, as html.
namespace bulbus::inline app {

/// Did it converge, and the figures that matter: of closing first, then pressures and changes; warnings.
std::string conclusions_of(const RunRecord& run);
/// Every probe at the end of every step, with its unit and its meaning.
std::string figures_of(const RunRecord& run);
/// Probes over the steps.
std::string histories_of(const RunRecord& run);
/// Iterations by step, seconds and memory by part, sizes.
std::string cost_of(const RunRecord& run);
/// resolved.yaml and the log.
std::string records_of(const RunRecord& run);
/// Versions and the files that were read.
std::string origin_of(const RunRecord& run);

/// Figures of two runs at the ends of their steps. Throws InputError if there is nothing to compare.
struct Differences {
  std::string verdict, table;
};
Differences differences_of(const RunRecord& a, const RunRecord& b);

/// What a probe measures; empty where that is not known.
std::string meaning_of(const RunRecord& run, const std::string& probe);

}  // namespace bulbus::inline app
