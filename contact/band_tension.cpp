#include "contact/band_tension.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/surfaces/meridians.hpp"
#include "core/base/error.hpp"
#include "core/mesh/distributed/bounds.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double widest_arc = 180 + 1e-9;  // degrees: the ends of a wider one open where it closes

}  // namespace

double band_opening(const RigidBodySpec& body, const std::string& name, const std::string& key) {
  if (!body.band || norm(body.direction) > 0 ||
      (body.band->arc.to - body.band->arc.from) / body.band->arc.parts > widest_arc)
    throw scene_error(
        key,
        "'" + name +
            "' is no band whose arcs, of at most half a turn each, close radially: it has no hoop "
            "force",
        "Name a `band` without `direction`, a longer one in several `parts`.");
  return (body.band->arc.to - body.band->arc.from) * std::numbers::pi / 180;
}

BandArcs band_arcs(const Problem& problem, const RigidSurface& band, const std::string& body,
                   const std::string& key) {
  const RigidBodySpec& spec = problem.model().rigid_bodies.at(body);
  BandArcs arcs{band_opening(spec, body, key)};
  const Meridians& about = spec.band->arc.meridians;
  const Vec3<double> axis = unit(about.axis);
  const double slack = 1e-6 * spec.band->radius;
  const Bounds model = bounds_of(problem.comm(), problem.mesh().X),
               drawn = bounds_of(problem.comm(), band.reference);
  for (const std::string& plane : problem.model().symmetry) {
    const int c = axis_of(plane);
    double beyond = -drawn.low[c], inside = drawn.high[c];
    if (model.side(c) < 0) std::swap(beyond, inside);
    if (std::abs(axis[c]) > 1 - 1e-6 && std::min(beyond, inside) > slack) arcs.widths = 2;
    if (std::abs(axis[c]) < 1e-6 && std::abs(about.center[c]) < slack && beyond > slack)
      throw scene_error(
          key,
          fmt::format("arcs of the band '{}' lie beyond the plane of symmetry {}, where nothing is drawn "
                      "that they could press on",
                      body, plane),
          fmt::format("Let the band end in the plane: change `from` and `to` of `rigid_bodies.{}.band`.",
                      body));
  }
  return arcs;
}

double band_tension(const RigidSurface& band, const BandArcs& arcs, std::span<const Wrench> on_arcs) {
  double outwards = 0;
  for (std::size_t p = 0; p < on_arcs.size(); ++p) outwards -= dot(on_arcs[p].force, band.parts[p].closes);
  return arcs.widths * outwards / (arcs.opening / (2 * std::numbers::pi) * band.shortening);
}

}  // namespace bulbus::inline contact
