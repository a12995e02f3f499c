#pragma once
#include <optional>

#include "app/prepare.hpp"

namespace bulbus::inline app {

/// One way to solve the scene of a trade.
struct TradeRun {
  std::string name;              ///< of its folder: run_001
  std::string parameter, value;  ///< what is varied, and to what
  std::vector<std::string> set;  ///< path.to.key=value, in their order
  int mesh = 0;                  ///< which of the meshes
  Scene scene;
};

/// A mesh of a trade.
struct TradeMesh {
  std::string words;  ///< "n 14, layers 2": the counts of cells that are others than the scene's
  std::optional<double>
      h;  ///< size of its cells, relative to those of the scene's mesh; none: of another shape
  std::vector<std::string> set;
  int reference = -1;  ///< the run that errors on this mesh count from
  std::string kept;    ///< "layers 1": counts that rounding has left as they are, so that there is no h
};

/// What a trade runs: the scene under a tight reference, as it is, with each `accuracy`, along each
/// parameter, and on other meshes: a coarser and a finer one, from which figures are extrapolated, and one
/// with twice the layers through the thickness.
struct Trade {
  std::string scene;              ///< its file
  std::vector<TradeMesh> meshes;  ///< the scene's first
  std::vector<TradeRun> runs;     ///< the reference, the scene as it is, then the others; no two the same
};

/// Plans the trade of a scene. `prepared` is the scene as it is: penalties count from those that its contacts
/// have. Throws InputError.
Trade plan_trade(const std::string& scene, const std::vector<std::string>& overrides,
                 const Prepared& prepared);

}  // namespace bulbus::inline app
