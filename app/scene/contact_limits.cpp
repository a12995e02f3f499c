#include "app/scene/contact_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/scene/size_limits.hpp"
#include "core/base/error.hpp"
#include "core/base/memory.hpp"

namespace bulbus::inline app {
namespace {

// A triangle with its corners, neighbours and, while these are looked for, edges; a contact point with its
// candidates and tangent; what a point remembers of each part of a body: benchmarks/notebook/memory.md.
constexpr double of_facet = 450, of_point = 1700, of_slot = 100;
// Facets and points are gone through in every Newton iteration: a million on a rank take seconds. 4 x 4
// points on each face are always allowed; a point's memory of a part costs less than the point.
constexpr double many = 1e6, usual_points_of_a_face = 16, slots_for_a_point = 20;

const ArcSpec* arc_of(const RigidBodySpec& spec) {
  return spec.swept ? &spec.swept->arc : spec.band ? &spec.band->arc : spec.tire ? &spec.tire->arc : nullptr;
}

double corners_of(const RigidBodySpec& spec) {
  if (spec.swept)
    return spec.swept->spline ? spec.swept->points + double(spec.swept->section.size())
                              : double(spec.swept->section.size());
  if (spec.band) return 4.0 * (spec.band->edge_facets + 1);
  return 4.0 * (spec.tire->edge_facets + 1) + spec.tire->face_facets;
}

double facets_of(const RigidBodySpec& spec) {
  if (spec.sphere) return 8.0 * spec.sphere->facets * spec.sphere->facets;
  if (spec.cylinder) return 4.0 * spec.cylinder->facets;
  const ArcSpec* arc = arc_of(spec);
  return arc ? 2.0 * arc->parts * corners_of(spec) * (double(arc->facets) + (arc->caps ? 1 : 0)) : 0;
}

int parts_of(const Scene& scene, const std::string& body) {
  const auto found = scene.model.rigid_bodies.find(body);
  const ArcSpec* arc = found != scene.model.rigid_bodies.end() ? arc_of(found->second) : nullptr;
  return arc ? arc->parts : 1;
}

// Things that contact goes through, on each rank or shared out to all.
struct Searched {
  std::string key, things, remedy;
  double count, most;
  double bytes;  // of all, over all ranks
};

void refuse(const Searched& s, const LinearSettings& l) {
  if (s.count > s.most)
    throw scene_error(s.key,
                      fmt::format("{:.3g} {} are more than can be searched in every iteration ({:.3g})",
                                  s.count, s.things, s.most),
                      s.remedy);
  if (s.bytes > memory_of(l))
    throw scene_error(
        s.key,
        fmt::format("{:.3g} {} would need {:.0f} MB of memory, more than the {:.0f} MB {}", s.count, s.things,
                    s.bytes / megabyte, memory_of(l) / megabyte, whose_memory(l)),
        s.remedy);
}

}  // namespace

void refuse_too_many_facets(const Scene& scene, int ranks) {
  for (const auto& [name, spec] : scene.model.rigid_bodies) {
    const double facets = facets_of(spec);
    refuse({"rigid_bodies." + name, "facets of the rigid body '" + name + "'",
            "Draw it with fewer parts and facets: a facet much smaller than the mesh's faces shows nothing.",
            facets, many, ranks * of_facet * facets},
           scene.solver.linear);
  }
}

void refuse_too_many_points(const Mesh& base, const Scene& scene, int ranks) {
  for (std::size_t i = 0; i < scene.model.contacts.size(); ++i) {
    const ContactSpec& c = scene.model.contacts[i];
    const auto slave = base.surfaces.find(c.slave);
    if (slave == base.surfaces.end()) continue;
    const double faces = double(slave->second.size()) * std::pow(4.0, scene.mesh.refine),
                 most = std::max(ranks * many, usual_points_of_a_face * faces),
                 points = faces * std::pow(std::max(1, c.divisions), 2),
                 slots = points * parts_of(scene, c.master);
    const std::string key = fmt::format("contacts.{}", i);
    refuse({key, fmt::format("points of contact '{}' on {:.3g} faces", c.name, faces),
            "Give smaller `divisions`: 2 to 4 suffice.", points, most, of_point * points},
           scene.solver.linear);
    refuse({key, fmt::format("pairs of points of contact '{}' and parts of '{}'", c.name, c.master),
            "Draw the body with fewer parts, or give smaller `divisions`.", slots, slots_for_a_point * most,
            of_slot * slots},
           scene.solver.linear);
  }
}

}  // namespace bulbus::inline app
