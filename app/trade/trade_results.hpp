#pragma once
#include "app/study/extrapolation.hpp"
#include "app/study/study_results.hpp"
#include "app/trade/trade.hpp"

namespace bulbus::inline app {

/// The largest error among the figures of a run, relative.
struct TradeError {
  double value = 0;
  int figure = -1;
};

/// What a trade has found. Seconds of its rows are processor time.
struct TradeResults : StudyResults {
  std::vector<double> least;      ///< of every figure: smaller ones count as this large
  std::vector<double> megabytes;  ///< largest resident set, of every run
  std::vector<std::optional<Extrapolated>> extrapolated;  ///< of every figure; none without other meshes
};

/// Relative error of a figure; of one below `least`, in parts of that. Of two zeros 0.
double relative_error(double value, double right, double least);

/// What a figure's magnitude is taken for at least, in its unit: .5 mm for lengths, so that 2 % of it are .01
/// mm, 5 mmHg for a liquid's pressure, 1 for a fraction of nodes; times its `scale`.
double least_of(const ProbeSpec& probe);

/// Fills `extrapolated` from the meshes' reference runs, as far as they are known.
void extrapolate(const Trade& trade, TradeResults& results);

/// The error of a figure against the tight solution on the same mesh, or against the extrapolated one. None
/// where one is not known.
std::optional<double> mesh_error(const Trade& trade, const TradeResults& results, int run, int figure);
std::optional<double> whole_error(const TradeResults& results, int run, int figure);

/// The largest over all figures. None if the run did not converge or nothing is known.
std::optional<TradeError> mesh_error(const Trade& trade, const TradeResults& results, int run);
std::optional<TradeError> whole_error(const TradeResults& results, int run);

/// What a run costs, and how wrong it is.
struct ParetoCandidate {
  int run;
  double seconds, error;
};

/// Seconds that differ by less than this part may be noise.
constexpr double noise = .05;

/// The best of those that are no less accurate and faster by more than noise; none: it lies on the Pareto
/// front.
const ParetoCandidate* better_than(const ParetoCandidate& one, const std::vector<ParetoCandidate>& all);

/// The runs that may be compared: those on the scene's mesh against its tight solution, but for the
/// reference; or all against the extrapolated one. By rising seconds.
std::vector<ParetoCandidate> candidates_on_mesh(const Trade& trade, const TradeResults& results);
std::vector<ParetoCandidate> candidates_on_all(const TradeResults& results);

}  // namespace bulbus::inline app
