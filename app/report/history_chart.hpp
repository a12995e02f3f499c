#pragma once
#include "app/plot/chart.hpp"
#include "app/records/history.hpp"

namespace bulbus::inline app {

/// Columns of a history, a panel each, over the column `over`. The history has at least one increment. Throws
/// InputError if there is no column of a name.
Chart chart_of(const History& history, const std::vector<std::string>& columns, const std::string& over,
               const std::string& title);

}  // namespace bulbus::inline app
