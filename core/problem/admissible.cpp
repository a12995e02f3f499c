#include "core/problem/admissible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/distributed/bounds.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline problem {
namespace {

// Of a liquid, relative to what it was enclosed with: ten times what Newton's criterion may miss.
constexpr double least_volume = 1e-6;
// Beyond a plane, relative to the mesh's size: what coordinates written with five digits are rounded to.
constexpr double tolerance = 1e-5;

std::string empty_liquid(const Problem& problem, const State& state) {
  for (const Liquid& liquid : problem.liquids())
    if (const double V = liquid.volume(state.x); !(V > least_volume * liquid.scale()))
      return fmt::format("liquid '{}' would have the volume {:.4g} mm3: its surface is turned inside out",
                         liquid.name(), problem.multiplicity() * V);
  return "";
}

// The model is drawn on one side of its planes.
std::string crossed_plane(const Problem& problem, const State& state) {
  if (problem.model().symmetry.empty()) return "";
  const LocalMesh& mesh = problem.mesh();
  const auto of_nodes = [&](std::span<const double> x) {
    return bounds_of(mesh.comm, x.first(3 * static_cast<std::size_t>(mesh.owned)));
  };
  const Bounds drawn = of_nodes(mesh.X), now = of_nodes(state.x);
  for (const std::string& plane : problem.model().symmetry) {
    const int c = axis_of(plane);
    const double low = std::min(drawn.low[c], 0.), high = std::max(drawn.high[c], 0.);
    const double beyond = drawn.side(c) > 0 ? -now.low[c] : now.high[c];
    if (beyond > tolerance * std::max(high, -low) + std::min(high, -low))
      return fmt::format("nodes would lie {:.3g} mm beyond the plane of symmetry {}", beyond, plane);
  }
  return "";
}

}  // namespace

std::string why_inadmissible(const Problem& problem, const State& state) {
  const std::string why = empty_liquid(problem, state);
  return why.empty() ? crossed_plane(problem, state) : why;
}

}  // namespace bulbus::inline problem
