#pragma once
#include <string>
#include <vector>

#include "app/plot/chart.hpp"

namespace bulbus::inline app {

/// A run of trade.csv: what it costs and how wrong it is.
struct TradePoint {
  std::string parameter;
  double seconds, error;  ///< of processor time; relative
  bool front;             ///< it lies on the Pareto front
};

/// The runs that are compared, by rising seconds: those on the scene's mesh against its tight solution, and
/// all against the extrapolated solution.
struct TradePoints {
  std::vector<TradePoint> on_mesh, on_all;
};

/// The file that write_trade_csv has written. Throws InputError with file and line if it is none. Not
/// collective.
TradePoints read_trade_points(const std::string& path);

/// Error over processor time, both in decades: the Pareto front, a curve for each of the four parameters that
/// have most runs on it, and what else was tried. Once against the same mesh, once against the extrapolated
/// solution.
Chart chart_of(const TradePoints& points);

}  // namespace bulbus::inline app
