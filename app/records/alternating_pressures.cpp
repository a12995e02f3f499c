#include "app/records/alternating_pressures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "precond/schur/oscillation_filter.hpp"

namespace bulbus::inline app {
namespace {

// In shear moduli. Stable states of usual meshes have less than one, nine hexahedra of a membrane two
// thousand times softer than its rim 48.
constexpr double much = 5;

}  // namespace

std::optional<AlternatingPressures> alternating_pressures(const Problem& problem, const State& state) {
  std::vector<double> p = state.lambda;
  OscillationFilter(problem).apply(p);
  std::optional<AlternatingPressures> most;
  for (const SolidRegion& r : problem.solid().regions()) {
    double amplitude = 0;
    for (int h = r.first; h < r.first + r.count; ++h) amplitude = std::max(amplitude, std::abs(p[h]));
    amplitude = problem.comm().max(amplitude);
    const double ratio = amplitude / initial_shear_modulus(r.material);
    if (ratio > (most ? most->ratio : much)) most = {r.name, amplitude, ratio};
  }
  return most;
}

std::string sentence(const AlternatingPressures& p) {
  return fmt::format(
      "the pressure of region '{}' alternates from hexahedron to hexahedron by {:.3g} MPa, {:.0f} times its "
      "shear modulus: its mesh is too coarse beside the stiffer parts that it is joined to. Give it more "
      "hexahedra: `mesh: {{refine: 1}}` splits each in eight",
      p.region, p.amplitude, p.ratio);
}

}  // namespace bulbus::inline app
