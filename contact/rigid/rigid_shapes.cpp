#include "contact/rigid/rigid_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "contact/rigid/surface_triangulation.hpp"
#include "contact/surfaces/meridians.hpp"
#include "core/base/error.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline contact {
namespace {

Vec3<double> mean_of(const std::vector<double>& points) {
  Vec3<double> mean{0, 0, 0};
  for (std::size_t i = 0; i < points.size(); ++i) mean[i % 3] += points[i];
  return (3. / static_cast<double>(points.size())) * mean;
}

// The centre is the mean of the corners.
void append(RigidSurface& body, const SurfaceTriangulation& surface,
            std::vector<std::array<int, 3>>& triangles, const Vec3<double>& inwards) {
  RigidSurface::Part part;
  part.first_point = static_cast<int>(body.reference.size() / 3);
  part.points = surface.size();
  part.first_triangle = static_cast<int>(triangles.size());
  part.triangles = static_cast<int>(surface.triangles.size());
  part.inwards = part.closes = inwards;
  part.center = mean_of(surface.points);
  body.reference.insert(body.reference.end(), surface.points.begin(), surface.points.end());
  for (const auto& [a, b, c] : surface.triangles)
    triangles.push_back({a + part.first_point, b + part.first_point, c + part.first_point});
  body.parts.push_back(part);
  for (const std::string& w : surface.warnings)
    body.warnings.push_back("rigid body '" + body.name + "': " + w);
}

// Ends are rounded up to this angle and flat beyond, where the profile has all but lost its rounded edges.
constexpr double last_tilt = 80 * std::numbers::pi / 180;
// Per facet of an edge: where both are rounded, neighbouring triangles are to differ by less than an edge.
constexpr double end_facets = 1.5;

// The profile of a shape, made smaller on all sides by an inset (mm), and how its ends are rounded.
struct ArcProfile {
  std::function<Profile(double inset)> at;
  double edge_radius = 0, radius = 1;  // mm; that of the arc's inner face
  int end_facets = 0;
};

template <class Shape>
ArcProfile rounded(const Shape& shape, const std::string& key) {
  const auto at = [shape, key](double inset) { return profile_of(made_smaller(shape, inset), key); };
  return {at, shape.edge_radius, shape.radius, static_cast<int>(std::ceil(end_facets * shape.edge_facets))};
}

std::vector<Station> stations_of(const Profile& profile, int facets, double from, double to) {
  std::vector<Station> stations;
  for (int k = 0; k <= facets; ++k) stations.push_back({from + (to - from) * k / facets, profile});
  return stations;
}

// One part between two azimuths (degrees), an end rounded as its edges are: a ball of the edges' radius rolls
// in it.
std::vector<Station> stations_of(const ArcProfile& profile, const ArcSpec& arc, double from, double to,
                                 Ends round) {
  const double end = profile.edge_radius * std::sin(last_tilt) / profile.radius * 180 / std::numbers::pi;
  std::vector<Station> stations =
      stations_of(profile.at(0), arc.facets, from + round.first * end, to - round.last * end);
  const auto station = [&](double core, double sign, int k) {
    const double tilt = last_tilt * k / profile.end_facets;
    return Station{core + sign * end * std::sin(tilt) / std::sin(last_tilt),
                   profile.at(profile.edge_radius * (1 - std::cos(tilt)))};
  };
  for (int k = 1; round.first && k <= profile.end_facets; ++k)
    stations.insert(stations.begin(), station(from + end, -1, k));
  for (int k = 1; round.last && k <= profile.end_facets; ++k) stations.push_back(station(to - end, 1, k));
  return stations;
}

// An end in a plane of symmetry is none: the body goes on as its image, without a cap and the edges of one.
bool goes_on(const MeridianFrame& frame, double azimuth, std::span<const std::string> symmetry) {
  const Vec3<double> normal = cross(frame.axis, frame.radius(azimuth));
  return std::ranges::any_of(symmetry, [&](const std::string& plane) {
    const int c = axis_of(plane);
    return std::abs(normal[c]) > 1 - 1e-9 && std::abs(frame.center[c]) < 1e-9 * (1 + norm(frame.center));
  });
}

void append_arcs(RigidSurface& body, const ArcProfile& profile, const ArcSpec& arc,
                 const Vec3<double>& direction, std::span<const std::string> symmetry,
                 std::vector<std::array<int, 3>>& triangles, const std::string& key) {
  const double opening = arc.to - arc.from, step = opening / arc.parts;
  if (!(opening > 0) || opening > 360 + 1e-9)
    throw scene_error(key + ".to", "the arc spans " + std::to_string(opening) + " degrees",
                      "Let it span more than 0 and at most 360.");
  if (step / arc.facets >= 90)
    throw scene_error(key + ".facets", "a facet spans " + std::to_string(step / arc.facets) + " degrees",
                      "Let facets span less than 90.");
  const bool closed = arc.caps && opening < 360 - 1e-9;
  const double length = step * std::numbers::pi / 180 * profile.radius;
  const MeridianFrame frame(arc.meridians, key);
  const double half = step / 2 * std::numbers::pi / 180;
  if (step < 360 - 1e-9) body.shortening = 2 * std::numbers::pi * std::sin(half) / half;
  for (int p = 0; p < arc.parts; ++p) {
    const double from = arc.from + step * p, to = from + step;
    const bool radial = norm(direction) == 0 && step < 360 - 1e-9;  // a whole ring has no middle
    const Ends free{closed && p == 0 && !goes_on(frame, from, symmetry),
                    closed && p == arc.parts - 1 && !goes_on(frame, to, symmetry)};
    const Ends ends = profile.edge_radius > 0 ? free : Ends{};
    if (ends.count() * profile.edge_radius >= length)
      throw scene_error(
          key + ".edge_radius", "the rounded ends do not fit into the arc",
          "Keep edge_radius below the length of a part, or below half of it where both of its ends "
          "are free; or leave the ends open: `caps: false`.");
    append(body, sweep(stations_of(profile, arc, from, to, ends), frame, free), triangles,
           radial ? -1 * frame.radius(from + step / 2) : direction);
    if (ends.count() > 0)  // as if they were not rounded, so that it lies on the middle's radius
      body.parts.back().center =
          mean_of(sweep(stations_of(profile.at(0), arc.facets, from, to), frame, free).points);
  }
}

}  // namespace

RigidSurface make_rigid_surface(const std::string& name, const RigidBodySpec& spec, const std::string& key,
                                std::span<const std::string> symmetry) {
  spec.validate();
  RigidSurface body;
  body.name = name;
  std::vector<std::array<int, 3>> triangles;
  const Vec3<double> given = norm(spec.direction) > 0 ? unit(spec.direction) : spec.direction;
  if (spec.plane)
    append(body, triangulated(*spec.plane, key + ".plane"), triangles,
           norm(given) > 0 ? given : unit(spec.plane->normal));
  if (spec.sphere) append(body, triangulated(*spec.sphere), triangles, given);
  if (spec.cylinder) append(body, triangulated(*spec.cylinder, key + ".cylinder"), triangles, given);
  if (spec.file) append(body, triangulated(*spec.file, key + ".file"), triangles, given);
  if (spec.swept) {
    const Profile profile = profile_of(*spec.swept, key + ".swept");
    append_arcs(body, {[&](double) { return profile; }}, spec.swept->arc, given, symmetry, triangles,
                key + ".swept");
  }
  if (spec.band)
    append_arcs(body, rounded(*spec.band, key + ".band"), spec.band->arc, given, symmetry, triangles,
                key + ".band");
  if (spec.tire)
    append_arcs(body, rounded(*spec.tire, key + ".tire"), spec.tire->arc, given, symmetry, triangles,
                key + ".tire");
  body.facets = make_facets(std::move(triangles), body.reference);
  body.places = body.reference;
  body.normals = body.reference_normals = corner_normals(body.facets, body.reference);
  return body;
}

}  // namespace bulbus::inline contact
