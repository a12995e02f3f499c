#include "contact/rigid/rigid_shapes.hpp"

#include "contact/rigid/skin.hpp"
#include "contact/surfaces/meridians.hpp"

namespace bulbus {
namespace {

// The centre is the mean of the corners.
void append(RigidSurface& body, const Skin& skin, std::vector<std::array<int, 3>>& triangles,
            const Vec3<double>& inwards) {
  RigidSurface::Part part;
  part.first_point = static_cast<int>(body.reference.size() / 3);
  part.points = skin.size();
  part.first_triangle = static_cast<int>(triangles.size());
  part.triangles = static_cast<int>(skin.triangles.size());
  part.inwards = inwards;
  for (std::size_t i = 0; i < skin.points.size(); ++i) part.center[i % 3] += skin.points[i] / part.points;
  body.reference.insert(body.reference.end(), skin.points.begin(), skin.points.end());
  for (const auto& [a, b, c] : skin.triangles)
    triangles.push_back({a + part.first_point, b + part.first_point, c + part.first_point});
  body.parts.push_back(part);
  for (const std::string& w : skin.warnings) body.warnings.push_back("rigid body '" + body.name + "': " + w);
}

void append_arcs(RigidSurface& body, const Section& section, const ArcSpec& arc,
                 const Vec3<double>& direction, std::vector<std::array<int, 3>>& triangles,
                 const std::string& key) {
  const double opening = arc.to - arc.from, step = opening / arc.parts;
  if (!(opening > 0) || opening > 360 + 1e-9)
    throw scene_error(key + ".to", "the arc spans " + std::to_string(opening) + " degrees",
                      "Let it span more than 0 and at most 360.");
  if (step / arc.facets >= 90)
    throw scene_error(key + ".facets", "a facet spans " + std::to_string(step / arc.facets) + " degrees",
                      "Let facets span less than 90.");
  const MeridianFrame frame(arc.meridians, key);
  for (int p = 0; p < arc.parts; ++p) {
    const double from = arc.from + step * p;
    const bool radial = norm(direction) == 0 && step < 360 - 1e-9;  // a whole ring has no middle
    append(body, sweep(section, arc, from, from + step, key), triangles,
           radial ? -1 * frame.radius(from + step / 2) : direction);
  }
}

}  // namespace

RigidSurface make_rigid_surface(const std::string& name, const RigidBodySpec& spec, const std::string& key) {
  spec.validate();
  RigidSurface body;
  body.name = name;
  std::vector<std::array<int, 3>> triangles;
  const Vec3<double> given = norm(spec.direction) > 0 ? unit(spec.direction) : spec.direction;
  if (spec.plane)
    append(body, skin_of(*spec.plane, key + ".plane"), triangles,
           norm(given) > 0 ? given : unit(spec.plane->normal));
  if (spec.sphere) append(body, skin_of(*spec.sphere), triangles, given);
  if (spec.cylinder) append(body, skin_of(*spec.cylinder, key + ".cylinder"), triangles, given);
  if (spec.file) append(body, skin_of(*spec.file, key + ".file"), triangles, given);
  if (spec.swept)
    append_arcs(body, section_of(*spec.swept, key + ".swept"), spec.swept->arc, given, triangles,
                key + ".swept");
  if (spec.band)
    append_arcs(body, section_of(*spec.band, key + ".band"), spec.band->arc, given, triangles, key + ".band");
  if (spec.tire)
    append_arcs(body, section_of(*spec.tire, key + ".tire"), spec.tire->arc, given, triangles, key + ".tire");
  body.facets = make_facets(std::move(triangles), body.reference);
  body.places = body.reference;
  body.normals = body.reference_normals = corner_normals(body.facets, body.reference);
  return body;
}

}  // namespace bulbus
