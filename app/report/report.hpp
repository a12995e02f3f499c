#pragma once
#include <string>

namespace bulbus::inline app {

/// Of two runs, in the folder of the first.
inline constexpr const char* comparison_file = "comparison.html";

/// A run as one page: conclusions, model in 3-D, figures, histories, cost, scene. Throws InputError if the
/// folder has no records of a run. Not collective.
std::string run_report(const std::string& folder);

/// Two runs side by side, with the differences of their figures. Throws InputError. Not collective.
std::string comparison_report(const std::string& first, const std::string& second);

/// The figure and the table of a study, with links to the reports of its runs. Throws InputError. Not
/// collective.
std::string study_report(const std::string& folder);

/// Writes the report of a run, of two (`second` not empty) or of a study, whose runs get theirs, to `file`
/// (empty: in the folder); returns its path. Throws InputError, and std::runtime_error if it cannot be
/// written. Not collective.
std::string write_report(const std::string& folder, const std::string& second, const std::string& file);

}  // namespace bulbus::inline app
