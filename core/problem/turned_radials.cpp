#include "core/problem/turned_radials.hpp"

#include <fmt/format.h>

#include <array>

#include "core/problem/problem.hpp"
#include "core/problem/set_motion.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double seen = 1e-3;  // of the radius

// Largest distance from the circle, mm, and radius there. The constraint keeps d·r, not |r|.
std::array<double, 2> worst(const Problem& problem, const RadialHold& hold, const State& state) {
  std::array<double, 2> all{0, 0};
  for (const auto& [n, d] : hold.directions) {
    if (n >= problem.mesh().owned || !problem.dofs().constrains(n, d)) continue;
    const Vec3<double> r = from_axis(hold.spec, at(state.x, n));
    const double kept = dot(d, r), missed = norm(r) - kept;
    if (missed > seen * kept && missed > all[0]) all = {missed, kept};
  }
  return all;
}

}  // namespace

std::vector<std::string> turned_radials(const Problem& problem, const State& state) {
  std::vector<std::string> sentences;
  for (const auto& [label, hold] : problem.radial_holds()) {
    const auto own = worst(problem, hold, state);
    const double missed = problem.comm().max(own[0]), radius = problem.comm().max(own[1]);
    if (missed > 0)
      sentences.push_back(
          fmt::format("nodes of '{}' have turned about the axis of their radial displacement within a step, "
                      "and are up to {:.3g} mm "
                      "farther from it than it says (radius {:.4g} mm): it acts in the direction from the "
                      "axis at the start of the "
                      "step. Divide the step into several, each with the displacement",
                      hold.spec.set, missed, radius));
  }
  return sentences;
}

}  // namespace bulbus::inline problem
