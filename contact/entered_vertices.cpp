#include "contact/entered_vertices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/search/local_search.hpp"
#include "contact/search/nearest_point.hpp"
#include "contact/search/position_codes.hpp"
#include "core/base/sort_unique.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double beside_points = .25, untouched = .1;  // of the width of a face, its area's root

std::vector<double> vertices_of_master(const Interactions::Contact& c, const LocalMesh& mesh,
                                       std::span<const double> x) {
  if (c.body) return c.body->places;
  std::vector<int> nodes;
  for (const Quad& q : mesh.shared.at(c.spec.master)) nodes.insert(nodes.end(), q.begin(), q.end());
  sort_unique(nodes);
  std::vector<double> places;
  for (int n : nodes) places.insert(places.end(), &x[3 * n], &x[3 * n] + 3);
  return places;
}

// The slave's face nearest to x, or −1: only a point whose projection lies on that face is known to be behind
// it.
int face_over(const Vec3<double>& x, std::span<const int> candidates, const Facets& faces,
              std::span<const double> places) {
  int nearest = -1;
  double distance = INFINITY;
  for (int t : candidates)
    if (const double d = nearest_point(x, corners_of(faces, places, t)).distance; d < distance)
      nearest = t, distance = d;
  if (nearest >= 0 && std::ranges::min(project(x, corners_of(faces, places, nearest)).weights) < -1e-6)
    return -1;
  return nearest;
}

double width(const Triangle& half_face) {
  return std::sqrt(norm(cross(minus(half_face[1], half_face[0]), minus(half_face[2], half_face[0]))));
}

// The deepest vertex beyond what may be, if there is one: points 0 else.
Overlap entered(const Interactions::Contact& c, const LocalMesh& mesh, std::span<const double> x,
                double penetration) {
  const double part = penetration > 0 ? beside_points : untouched;
  const auto vertices = vertices_of_master(c, mesh, x);
  const Facets faces{triangles_of(mesh.shared.at(c.spec.slave)), {}};
  const Candidates near = find_candidates(vertices, faces.triangles, x, c.thickness / 2);
  Overlap deepest{};
  for (int i = 0; i < static_cast<int>(vertices.size() / 3); ++i) {
    const Vec3<double> vertex = at(vertices, i);
    const int t = face_over(vertex, near.of(i), faces, x);
    if (t < 0) continue;
    const Triangle face = corners_of(faces, x, t);
    const double depth = -project(vertex, face).gap;
    if (depth > penetration + part * width(face)) deepest.add(depth, vertex);
  }
  return deepest;
}

}  // namespace

std::vector<std::string> entered_vertices(const Problem& problem, const Interactions& interactions,
                                          const State& state) {
  std::vector<std::string> sentences;
  for (const auto& c : interactions.contacts()) {
    double penetration = c.term->penetration(state);
    if (c.exchanged) penetration = std::max(penetration, c.exchanged->penetration(state));
    penetration = problem.comm().max(penetration);
    const Overlap o = entered(c, problem.mesh(), state.x, penetration);
    if (o.points == 0) continue;
    sentences.push_back(fmt::format(
        "'{}' enters '{}' by {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) between the points of contact '{}', which "
        "feel {:.3g} mm: its force is too small. Give more `divisions`{}, or refine '{}'",
        c.spec.master, c.spec.slave, o.depth, o.place[0], o.place[1], o.place[2], c.spec.name, penetration,
        c.body ? "" : " or `two_way: true`", c.spec.slave));
  }
  return sentences;
}

}  // namespace bulbus::inline contact
