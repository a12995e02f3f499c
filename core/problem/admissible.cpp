#include "core/problem/admissible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  const LocalMesh& mesh = problem.mesh();
  for (const std::string& plane : problem.model().symmetry) {
    const int c = axis_of(plane);
    double low = 0, high = 0, least = 0, most = 0;
    for (int n = 0; n < mesh.owned; ++n) {
      low = std::min(low, mesh.X[3 * n + c]), high = std::max(high, mesh.X[3 * n + c]);
      least = std::min(least, state.x[3 * n + c]), most = std::max(most, state.x[3 * n + c]);
    }
    low = mesh.comm.min(low), high = mesh.comm.max(high);
    const double beyond = high > -low ? -mesh.comm.min(least) : mesh.comm.max(most);
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
