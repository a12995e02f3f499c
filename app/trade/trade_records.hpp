#pragma once
#include "app/trade/trade_results.hpp"

namespace bulbus::inline app {

/// For people: every run with cost and largest errors, the Pareto fronts, and what is dominated by what.
std::vector<std::string> lines_of(const Trade& trade, const TradeResults& results);

/// Writes trade.csv: a row per run done, with every figure and both its errors. Throws std::runtime_error.
/// Not collective.
void write_trade_csv(const std::string& path, const Trade& trade, const TradeResults& results);

}  // namespace bulbus::inline app
