#include "core/problem/symmetry_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/hex_edges.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double of_diagonal = 1e-5;  // default tolerance: coordinates written with five digits
constexpr double of_edge = .02;       // nearer than this, a face is meant to be on the plane

// Nodes beside the plane, between the mesh's round-off and a distance.
std::vector<bool> beside(const Mesh& mesh, int c, double distance) {
  const double tolerance = mesh_tolerance(mesh);
  std::vector<bool> found(mesh.points.size());
  for (std::size_t n = 0; n < found.size(); ++n) {
    const double x = std::abs(mesh.points[n][c]);
    found[n] = x > tolerance && x <= distance;
  }
  return found;
}

// Takes out the nodes that are farther from the plane than a fiftieth of their shortest edge.
void keep_near_ones(const Mesh& mesh, int c, std::vector<bool>& nodes) {
  std::vector<bool> far(nodes.size());
  for (const Hex& h : mesh.hexes)
    for (const auto& [i, j] : hex_edges)
      for (const auto& [a, b] : {std::pair{h[i], h[j]}, {h[j], h[i]}})
        if (nodes[a] && std::abs(mesh.points[a][c]) > of_edge * norm(mesh.points[a] - mesh.points[b]))
          far[a] = true;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (far[n]) nodes[n] = false;
}

// A plane that no node lies on cuts nothing: the whole would be two bodies.
void require_cut(const Mesh& mesh, const std::string& plane) {
  const int c = axis_of(plane);
  const auto [low, high] = std::ranges::minmax_element(mesh.points, {}, [c](const Point& p) { return p[c]; });
  if ((*low)[c] <= mesh_tolerance(mesh) && (*high)[c] >= -mesh_tolerance(mesh)) return;
  throw scene_error(
      "symmetry",
      fmt::format("no node lies on the symmetry plane {} = 0: the mesh reaches from {:g} to {:g} mm", plane,
                  (*low)[c], (*high)[c]),
      fmt::format("Draw the mesh with its cut at {} = 0, or take the plane out of `symmetry`.", plane));
}

void require_one_side(const Mesh& mesh, const std::string& plane) {
  const double tolerance = mesh_tolerance(mesh);
  const int c = axis_of(plane);
  const auto [low, high] = std::ranges::minmax_element(mesh.points, {}, [c](const Point& p) { return p[c]; });
  const double below = -(*low)[c], above = (*high)[c];
  if (below <= tolerance || above <= tolerance) return;
  const double beyond = std::min(below, above);
  throw scene_error(
      "symmetry",
      fmt::format("the mesh lies on both sides of the symmetry plane {} = 0 (from {:g} to {:g} mm)", plane,
                  (*low)[c], (*high)[c]),
      beyond < of_edge * std::max(below, above)
          ? fmt::format("If these are nodes of the plane with noise, say `symmetry_tolerance: {:.2g} mm`.",
                        1.1 * beyond)
          : "A symmetric model is drawn on one side; take the plane out of `symmetry`.");
}

// Faces near the plane c that look at it and are not on it.
std::vector<Quad> faces_along(const Mesh& mesh, int c) {
  const double tolerance = mesh_tolerance(mesh);
  std::vector<Quad> found;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const Hex& hex = mesh.hexes[h];
    const auto [near, far] = std::ranges::minmax(hex, {}, [&](int n) { return std::abs(mesh.points[n][c]); });
    if (!(std::abs(mesh.points[near][c]) <= of_edge * norm(mesh.points[hex[0]] - mesh.points[hex[6]])))
      continue;
    const double side = mesh.points[far][c];
    for (int f = 0; f < 6; ++f) {
      const Quad q = face_nodes(mesh.hexes, static_cast<int>(6 * h + f));
      double edge = std::numeric_limits<double>::infinity(), distance = 0;
      for (int i = 0; i < 4; ++i) {
        edge = std::min(edge, norm(mesh.points[q[i]] - mesh.points[q[(i + 1) % 4]]));
        distance = std::max(distance, std::abs(mesh.points[q[i]][c]));
      }
      const Point normal =
          cross(mesh.points[q[2]] - mesh.points[q[0]], mesh.points[q[3]] - mesh.points[q[1]]);
      if (distance > tolerance && distance <= of_edge * edge && normal[c] * side < 0) found.push_back(q);
    }
  }
  return found;
}

void require_held(const Mesh& mesh, const std::string& plane) {
  const int c = axis_of(plane);
  auto faces = faces_along(mesh, c);
  if (faces.empty()) return;
  const FaceTable table(mesh.hexes);
  std::erase_if(faces, [&](const Quad& q) { return table.count(q) != 1; });
  if (faces.empty()) return;
  double distance = 0;
  Point place{};
  for (const Quad& q : faces)
    for (int n : q)
      if (const double d = std::abs(mesh.points[n][c]); d > distance) distance = d, place = mesh.points[n];
  throw scene_error(
      "symmetry",
      fmt::format(
          "{} faces lie along the symmetry plane {} = 0, up to {:.3g} mm beside it, and are not constrained "
          "there; the farthest node is at ({:.4g}, {:.4g}, {:.4g})",
          faces.size(), plane, distance, place[0], place[1], place[2]),
      fmt::format("If they are meant to be on the plane, say `symmetry_tolerance: {:.2g} mm`; otherwise take "
                  "the plane out of `symmetry`, or draw the mesh farther away from it.",
                  1.1 * distance));
}

}  // namespace

void move_onto_planes(Mesh& mesh, const Model& model) {
  const double distance = model.symmetry_tolerance.value_or(of_diagonal * diagonal(mesh));
  for (const std::string& plane : model.symmetry) {
    const int c = axis_of(plane);
    std::vector<bool> nodes = beside(mesh, c, distance);
    if (std::ranges::none_of(nodes, [](bool b) { return b; })) continue;
    if (!model.symmetry_tolerance) keep_near_ones(mesh, c, nodes);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (nodes[n]) mesh.points[n][c] = 0;
  }
}

void require_at_planes(const Mesh& mesh, const Model& model) {
  for (const std::string& plane : model.symmetry) {
    require_one_side(mesh, plane);
    require_held(mesh, plane);
    require_cut(mesh, plane);
  }
}

}  // namespace bulbus::inline problem
