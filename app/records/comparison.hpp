#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/records/history.hpp"

namespace bulbus::inline app {

/// Differences that count as none.
struct CompareOptions {
  double relative = 1e-6;  ///< parts of the largest magnitude that the probe has in both runs
  double absolute = 0;     ///< in the probe's unit
};

/// The figures of two runs at the end of a step; none where a run does not know one.
struct ComparedFigure {
  std::string step, probe, unit;
  std::optional<double> first, second;
  double largest = 0;  ///< magnitude of the probe in both runs
  double difference() const { return *second - *first; }
  double relative() const { return largest > 0 ? difference() / largest : 0; }
  bool differs(const CompareOptions& options) const;
};

/// Of every step its time, where the two ends are not the same, and its probes. Throws InputError if a probe
/// has two units, or there is nothing to compare.
std::vector<ComparedFigure> compared_figures(const History& first, const History& second);

}  // namespace bulbus::inline app
