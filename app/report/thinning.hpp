#pragma once
#include "app/report/run_record.hpp"

namespace bulbus::inline app {

/// How much of a run a page shows.
struct Thinning {
  int states = 1000000;  ///< at most
  bool inside = true;    ///< the hexahedra, else the surfaces alone
  double cube = 0;  ///< nodes of surfaces in the same cube are one: parts of the model's diagonal; 0: none
};

/// From everything to little: the first whose page is small enough is taken.
std::vector<Thinning> thinnings();

/// At most so many frames of the run: the first, the last, ends of steps before others.
std::vector<int> chosen_frames(const RunRecord& run, int at_most);

}  // namespace bulbus::inline app
