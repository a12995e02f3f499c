#include "app/report/thinning.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace bulbus::inline app {
namespace {

bool ends_a_step(const RunRecord::Frame& frame) {
  return std::abs(frame.time - std::round(frame.time)) < 1e-9;
}

// So many of a list at equal distances, its first and last among them.
std::vector<int> spread(const std::vector<int>& all, int count) {
  const int most = static_cast<int>(all.size());
  if (count >= most) return all;
  std::vector<int> some;
  for (int i = 0; i < count; ++i) some.push_back(all[count > 1 ? i * (most - 1) / (count - 1) : most - 1]);
  return some;
}

}  // namespace

std::vector<Thinning> thinnings() {
  return {{},         {.states = 12},   {.inside = false}, {12, false},      {6, false},
          {4, false}, {6, false, .004}, {4, false, .007},  {3, false, .012}, {2, false, .025}};
}

std::vector<int> chosen_frames(const RunRecord& run, int at_most) {
  std::vector<int> ends, others;
  const int count = static_cast<int>(run.frames.size());
  for (int f = 0; f < count; ++f)
    (f == 0 || f + 1 == count || ends_a_step(run.frames[f]) ? ends : others).push_back(f);
  std::vector<int> chosen = spread(ends, at_most);
  const int room = at_most - static_cast<int>(chosen.size());
  if (room > 0) std::ranges::copy(spread(others, room), std::back_inserter(chosen));
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace bulbus::inline app
