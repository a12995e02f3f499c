#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "app/eye/eye_parts.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"

namespace bulbus::inline eye {
namespace {

/// A point of a meridian turned to the azimuth `turn`·180° from +y; exactly on x = 0 at 0 and 1.
Point turned(const EyeShape::Place& p, double turn) {
  if (turn == 0) return {0, p.rho, p.z};
  if (turn == 1) return {0, -p.rho, p.z};
  const double phi = std::numbers::pi * turn;
  return {p.rho * std::sin(phi), p.rho * std::cos(phi), p.z};
}

/// Keeps the weights of the nodes on x = 0 only.
EmbeddedPoint onto_symmetry(const Mesh& mesh, EmbeddedPoint e) {
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    if (mesh.points[e.nodes[i]][0] != 0) e.weights[i] = 0;
    sum += e.weights[i];
  }
  if (!(sum > 0)) throw std::logic_error("a zonule on the plane of symmetry finds no edge of the mesh there");
  for (double& w : e.weights) w /= sum;
  return e;
}

/// Faces with an edge on x = 0.
std::vector<Quad> at_symmetry(const Mesh& mesh, const std::vector<Quad>& faces) {
  std::vector<Quad> cut;
  for (const Quad& q : faces)
    if (std::count_if(q.begin(), q.end(), [&](int k) { return mesh.points[k][0] == 0; }) >= 2)
      cut.push_back(q);
  return cut;
}

/// Faces of one tissue that bars may end on: all, and those at the plane of symmetry.
struct Ground {
  std::vector<Quad> all, cut;
  Ground(const Mesh& mesh, std::vector<Quad> faces) : all(std::move(faces)), cut(at_symmetry(mesh, all)) {}
  EmbeddedPoint end(const Mesh& mesh, const Point& target) const {
    if (target[0] != 0) return embed(mesh, all, target).point;
    return onto_symmetry(mesh, embed(mesh, cut, target).point);
  }
};

struct Row {
  int count;
  bool ends;  ///< a bar at either end, on the plane of symmetry
  EyeShape::Place lens, ciliary;
};

void check(const ZonuleLayout& z, const EyeShape& e) {
  for (const auto& [name, count, from] : {std::tuple{"equatorial_from", z.equatorial, z.equatorial_from},
                                          {"anterior_from", z.anterior, z.anterior_from},
                                          {"posterior_from", z.posterior, z.posterior_from}})
    if (count > 0 && !(from >= e.ora && from <= e.ciliary_end))
      throw input_error(
          fmt::format(
              "eye: zonules leave the ciliary body at {} = {:g} degrees, and it reaches from {:g} to {:g}",
              name, from, e.ora, e.ciliary_end),
          fmt::format("give `zonules: {{{}: ...}}` between the two", name));
  for (const auto& [name, count, inset] : {std::tuple{"anterior_inset", z.anterior, z.anterior_inset},
                                           {"posterior_inset", z.posterior, z.posterior_inset}})
    if (count > 0 && !(inset < .5 * e.lens_diameter))
      throw input_error(
          fmt::format("eye: the zonules' {} of {:g} mm is not less than the lens' radius, {:g} mm", name,
                      inset, .5 * e.lens_diameter),
          "give a smaller inset");
}

std::vector<Row> rows(const EyeSettings& s) {
  const EyeShape& e = s.shape;
  const ZonuleLayout& z = s.zonules;
  const auto inside = [&](double t) { return e.place(t, e.wall(t) + e.ciliary(t)); };
  const double rim = .5 * e.lens_diameter, front = rim - z.anterior_inset, back = rim - z.posterior_inset;
  return {{z.equatorial, true, {rim, .5 * (e.lens_top(rim) + e.lens_bottom(rim))}, inside(z.equatorial_from)},
          {z.anterior, false, {front, e.lens_top(front)}, inside(z.anterior_from)},
          {z.posterior, false, {back, e.lens_bottom(back)}, inside(z.posterior_from)}};
}

std::vector<Quad> ciliary_faces(const Mesh& mesh) {
  std::vector<bool> belongs(mesh.points.size(), false);
  for (int k : nodes_of(mesh, "ciliary_body")) belongs[k] = true;
  std::vector<Quad> faces;
  for (const Quad& q : mesh.surfaces.at("cavity"))
    if (belongs[q[0]] && belongs[q[1]] && belongs[q[2]] && belongs[q[3]]) faces.push_back(q);
  return faces;
}

}  // namespace

void add_zonules(Mesh& mesh, const EyeSettings& s) {
  check(s.zonules, s.shape);
  const Ground on_lens(mesh, mesh.surfaces.at("lens_surface")), on_ciliary(mesh, ciliary_faces(mesh));
  std::vector<Bar>& bars = mesh.bars["zonules"];
  for (const Row& row : rows(s))
    for (int i = 0; i < row.count; ++i) {
      const double turn = row.ends ? static_cast<double>(i) / (row.count - 1) : (i + .5) / row.count;
      const bool cut = turn == 0 || turn == 1;
      bars.push_back({on_lens.end(mesh, turned(row.lens, turn)),
                      on_ciliary.end(mesh, turned(row.ciliary, turn)), cut ? .5 : 1.0});
    }
}

}  // namespace bulbus::inline eye
