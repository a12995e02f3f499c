#include "contact/crossings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

#include "contact/search/position_codes.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/sorted.hpp"

namespace bulbus::inline contact {
namespace {

// Of contact k a slave is bit 2k, a master bit 2k + 1. Contacts beyond the 32nd share bits.
using Sides = unsigned long long;
constexpr Sides all_slaves = 0x5555555555555555ULL;
Sides slave_of(std::size_t contact) { return 1ULL << (2 * contact % 64); }
bool opposed(Sides a, Sides b) {
  return ((((a & all_slaves) << 1) & b) | (((b & all_slaves) << 1) & a)) != 0;
}

std::vector<Sides> sides_of_nodes(const LocalMesh& mesh, const Interactions& interactions) {
  std::vector<Sides> sides(mesh.nodes());
  const auto mark = [&](const std::string& surface, Sides bit) {
    for (const Quad& q : mesh.shared.at(surface))
      for (int n : q) sides[n] |= bit;
  };
  for (std::size_t k = 0; k < interactions.contacts().size(); ++k) {
    const auto& c = interactions.contacts()[k];
    mark(c.spec.slave, slave_of(k));
    if (!c.body) mark(c.spec.master, slave_of(k) << 1);
  }
  return sides;
}

// The boundary of the hexahedra and the rigid bodies, the same on every rank.
struct Boundary {
  std::vector<double> places;     // mm, 3 per corner
  std::vector<Sides> sides;       // of a corner
  std::vector<long long> number;  // of a corner's node; −1 of bodies
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> part;  // of a triangle: its region, or behind the regions a body
};

constexpr std::size_t of_face = 9;  // numbers: its four nodes, their sides, its region

int region_of(const LocalMesh& mesh, int hex) {
  int r = 0;
  while (hex >= mesh.regions[r].first + mesh.regions[r].count) ++r;
  return r;
}

// The outer faces of this rank's hexahedra, those of all ranks one after the other.
std::vector<long long> faces_of_all(const LocalMesh& mesh, const std::vector<Sides>& sides,
                                    std::span<const double> x, std::vector<double>& places) {
  std::vector<long long> own;
  std::vector<double> own_places;
  for (int f : outer_faces(mesh.hexes)) {
    const Quad q = face_nodes(mesh.hexes, f);
    for (int n : q) own.push_back(mesh.number[n]);
    for (int n : q) own.push_back(static_cast<long long>(sides[n]));
    own.push_back(region_of(mesh, f / 6));
    for (int n : q) own_places.insert(own_places.end(), &x[3 * n], &x[3 * n] + 3);
  }
  places = mesh.comm.gather(std::span<const double>(own_places));
  return mesh.comm.gather(std::span<const long long>(own));
}

// What two ranks have as an outer face lies between them.
void add_mesh(std::span<const long long> faces, std::span<const double> places, Boundary& all) {
  std::unordered_map<long long, int> corners;
  std::vector<Quad> quads(faces.size() / of_face);
  for (std::size_t i = 0; i < 4 * quads.size(); ++i) {
    const long long* face = &faces[i / 4 * of_face];
    const auto [corner, fresh] = corners.emplace(face[i % 4], static_cast<int>(corners.size()));
    quads[i / 4][i % 4] = corner->second;
    if (!fresh) continue;
    all.places.insert(all.places.end(), &places[3 * i], &places[3 * i] + 3);
    all.sides.push_back(static_cast<Sides>(face[4 + i % 4]));
    all.number.push_back(face[i % 4]);
  }
  std::map<Quad, int> ranks;
  for (const Quad& q : quads) ++ranks[sorted(q)];
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const Quad& q = quads[i];
    if (ranks[sorted(q)] > 1) continue;
    for (const auto& t : triangles_of(std::span(&q, 1)))
      all.triangles.push_back(t), all.part.push_back(static_cast<int>(faces[of_face * i + 8]));
  }
}

void add_bodies(const Interactions& interactions, int part, Boundary& all) {
  for (const auto& [name, body] : interactions.bodies()) {
    Sides sides = 0;
    for (std::size_t k = 0; k < interactions.contacts().size(); ++k)
      if (interactions.contacts()[k].body == body) sides |= slave_of(k) << 1;
    const int own = part++;
    if (sides == 0) continue;  // without a contact it is an outline for strings
    const int first = static_cast<int>(all.sides.size());
    all.places.insert(all.places.end(), body->places.begin(), body->places.end());
    all.sides.resize(all.places.size() / 3, sides);
    all.number.resize(all.sides.size(), -1);
    for (const auto& t : body->facets.triangles)
      all.triangles.push_back({first + t[0], first + t[1], first + t[2]}), all.part.push_back(own);
  }
}

// A line through a hexahedron, from face to opposite face, or one of its edges. The ends are off the faces'
// middles, which lie on the rims of triangles where nodes match.
constexpr std::array<double, 4> off_middle{.4, .28, .19, .13};
struct Line {
  Vec3<double> a, b;
};

std::vector<Line> lines_of(const LocalMesh& mesh, std::span<const double> x, int hex) {
  std::vector<Line> lines;
  std::array<Vec3<double>, 6> end{};
  for (int f = 0; f < 6; ++f) {
    const Quad q = face_nodes(mesh.hexes, 6 * hex + f);
    for (int i = 0; i < 4; ++i) {
      end[f] = end[f] + off_middle[i] * at(x, q[i]);
      if (q[i] < q[(i + 1) % 4]) lines.push_back({at(x, q[i]), at(x, q[(i + 1) % 4])});
    }
  }
  for (int f = 0; f < 6; ++f)
    for (int g = f + 1; g < 6; ++g) {
      const Quad p = face_nodes(mesh.hexes, 6 * hex + f), q = face_nodes(mesh.hexes, 6 * hex + g);
      if (std::ranges::find_first_of(p, q) == p.end()) lines.push_back({end[f], end[g]});
    }
  return lines;
}

// Does the line lead through the triangle, clear of its rim and of its own ends? Surfaces that just touch do
// not cross.
bool crosses(const Line& line, const Triangle& v) {
  constexpr double clear = .02;  // of the line, of the triangle's heights
  const Vec3<double> n = cross(minus(v[1], v[0]), minus(v[2], v[0]));
  const double from = dot(minus(line.a, v[0]), n), to = dot(minus(line.b, v[0]), n),
               part = from / (from - to);
  if (from == to || !(part > clear && part < 1 - clear)) return false;
  const Vec3<double> x = line.a + part * minus(line.b, line.a);
  for (int i = 0; i < 3; ++i) {
    const Vec3<double>&p = v[(i + 1) % 3], &q = v[(i + 2) % 3];
    if (!(dot(cross(minus(q, p), minus(x, p)), n) > clear * dot(n, n))) return false;
  }
  return true;
}

// Of two parts, the least position by its coordinates.
using Crossings = std::map<std::pair<int, int>, Vec3<double>>;

void keep_least(Crossings& all, const std::pair<int, int>& parts, const Vec3<double>& place) {
  const auto [known, fresh] = all.emplace(parts, place);
  if (!fresh) known->second = std::min(known->second, place);
}

// The triangles near a hexahedron that are not its own and that no contact keeps out of it.
std::vector<int> unheld(const LocalMesh& mesh, const std::vector<Sides>& sides, const Boundary& all,
                        const Hex& hex, std::span<const int> near) {
  Sides own = 0;
  for (int n : hex) own |= sides[n];
  std::vector<int> triangles;
  for (int t : near) {
    const auto& c = all.triangles[t];
    const auto joined = [&](int n) {
      return std::ranges::any_of(c, [&](int k) { return all.number[k] == mesh.number[n]; });
    };
    if (!opposed(own, all.sides[c[0]] | all.sides[c[1]] | all.sides[c[2]]) &&
        std::ranges::none_of(hex, joined))
      triangles.push_back(t);
  }
  return triangles;
}

void cross_hexahedra(const LocalMesh& mesh, const std::vector<Sides>& sides, std::span<const double> x,
                     const Boundary& all, int first, int last, Crossings& found) {
  std::vector<double> corners;
  for (int h = first; h < last; ++h)
    for (int n : mesh.hexes[h]) corners.insert(corners.end(), &x[3 * n], &x[3 * n] + 3);
  const Candidates near = find_candidates(corners, all.triangles, all.places, 0, 8);
  for (int h = first; h < last; ++h) {
    const auto triangles = unheld(mesh, sides, all, mesh.hexes[h], near.of(8 * (h - first)));
    if (triangles.empty()) continue;
    for (const Line& line : lines_of(mesh, x, h))
      for (int t : triangles) {
        const auto& c = all.triangles[t];
        if (crosses(line, {at(all.places, c[0]), at(all.places, c[1]), at(all.places, c[2])}))
          keep_least(found, std::minmax(region_of(mesh, h), all.part[t]), line.a);
      }
  }
}

Crossings of_all_ranks(const Crossings& own, const Comm& comm) {
  std::vector<double> flat;
  for (const auto& [parts, place] : own)
    flat.insert(flat.end(), {double(parts.first), double(parts.second), place[0], place[1], place[2]});
  const auto every = comm.gather(std::span<const double>(flat));
  Crossings all;
  for (std::size_t i = 0; i < every.size(); i += 5)
    keep_least(all, {int(every[i]), int(every[i + 1])}, {every[i + 2], every[i + 3], every[i + 4]});
  return all;
}

}  // namespace

std::vector<std::string> crossed_surfaces(const Problem& problem, const Interactions& interactions,
                                          const State& state) {
  const LocalMesh& mesh = problem.mesh();
  const auto sides = sides_of_nodes(mesh, interactions);
  std::vector<std::string> names;
  for (const std::string& region : mesh.region_names) names.push_back("region '" + region + "'");
  Boundary all;
  std::vector<double> places;
  const auto faces = faces_of_all(mesh, sides, state.x, places);
  add_mesh(faces, places, all);
  add_bodies(interactions, static_cast<int>(names.size()), all);
  for (const auto& [name, body] : interactions.bodies()) names.push_back("rigid body '" + name + "'");
  Crossings own;
  const int count = static_cast<int>(mesh.hexes.size());
  // The corners of a hexahedron take 200 bytes, half of what a run does: not all at once. Each time all
  // triangles are looked through.
  const int at_once = std::max(10000, count / 10);
  for (int h = 0; h < count; h += at_once)
    cross_hexahedra(mesh, sides, state.x, all, h, std::min(h + at_once, count), own);
  std::vector<std::string> sentences;
  for (const auto& [parts, x] : of_all_ranks(own, mesh.comm))
    sentences.push_back(fmt::format(
        "{} passes through {} near ({:.4g}, {:.4g}, {:.4g}) mm, which no bodies do: name the two surfaces "
        "there "
        "as slave and master of a contact, or end the run before",
        names[parts.second], parts.first == parts.second ? "itself" : names[parts.first], x[0], x[1], x[2]));
  return sentences;
}

}  // namespace bulbus::inline contact
