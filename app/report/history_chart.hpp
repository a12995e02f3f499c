#pragma once
#include "app/plot/chart.hpp"
#include "app/records/history.hpp"

namespace bulbus::inline app {

/// Probes of a history over the steps done, a panel each. The history has at least one increment. Throws
/// InputError if there is no probe of a name.
Chart chart_of(const History& history, const std::vector<std::string>& probes, const std::string& title);

}  // namespace bulbus::inline app
