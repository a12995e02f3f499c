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

/// A figure of two runs at the end of a step; one of them may lack it.
struct ComparedFigure {
  std::string step, probe, unit;
  std::optional<double> first, second;
  double largest = 0;  ///< magnitude of the probe in both runs
  double difference() const { return *second - *first; }
  double relative() const { return largest > 0 ? difference() / largest : 0; }
  bool differs(const CompareOptions& options) const;
  /// In words, for tables; empty where it does not differ.
  std::string verdict(const CompareOptions& options) const;
};

/// Of every step its time, where the two ends are not the same, and the probes that at least one of the runs
/// has. Throws InputError if a probe has two units, or there is nothing to compare.
std::vector<ComparedFigure> compared_figures(const History& first, const History& second);

}  // namespace bulbus::inline app
