#include "core/problem/hanging_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/base/sort_unique.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/contact_nodes.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double on_face = .01, at_corner = .02;  // distances in parts of the face's shortest edge

using Corners = std::array<Point, 4>;

double shortest_side(const Corners& q) {
  double least = norm(q[0] - q[3]);
  for (int i = 0; i < 3; ++i) least = std::min(least, norm(q[i] - q[i + 1]));
  return least;
}

struct Box {
  Point low, high;
  Box(const Corners& q, double margin) : low(q[0]), high(q[0]) {
    for (int c = 0; c < 3; ++c) {
      for (const Point& p : q) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
      low[c] -= margin, high[c] += margin;
    }
  }
};

// Nodes by cells of a grid.
class NodeGrid {
 public:
  NodeGrid(const Mesh& mesh, const std::vector<int>& nodes, double cell) : cell_(cell) {
    for (int n : nodes) cells_[key(mesh.points[n])].push_back(n);
  }
  template <class Visit>
  void visit(const Box& box, Visit visit) const {
    const auto low = key(box.low), high = key(box.high);
    for (int i = low[0]; i <= high[0]; ++i)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int k = low[2]; k <= high[2]; ++k)
          if (const auto at = cells_.find({i, j, k}); at != cells_.end())
            for (int n : at->second) visit(n);
  }

 private:
  using Key = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      return static_cast<std::size_t>(k[0]) * 73856093u ^ static_cast<std::size_t>(k[1]) * 19349663u ^
             static_cast<std::size_t>(k[2]) * 83492791u;
    }
  };
  Key key(const Point& p) const {
    Key k;
    for (int c = 0; c < 3; ++c) k[c] = static_cast<int>(std::floor(p[c] / cell_));
    return k;
  }
  double cell_;
  std::unordered_map<Key, std::vector<int>, Hash> cells_;
};

bool hangs(const Mesh& mesh, int node, const Quad& face, const Corners& q, double shortest) {
  if (std::ranges::count(face, node) > 0) return false;
  const Point& x = mesh.points[node];
  if (std::ranges::any_of(q, [&](const Point& p) { return norm(p - x) < at_corner * shortest; }))
    return false;
  return project(x, q).distance < on_face * shortest;
}

}  // namespace

std::vector<std::string> hanging_nodes(const Mesh& mesh, const Model& model) {
  std::vector<int> owner;
  const std::vector<Quad> faces = boundary_faces(mesh, &owner);
  if (faces.empty()) return {};
  std::vector<int> region(mesh.points.size(), -1);
  double edges = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int n : faces[f]) region[n] = mesh.region[owner[f]];
    edges += shortest_side(corners(mesh, faces[f]));
  }
  const NodeGrid grid(mesh, nodes_of_faces(faces), edges / static_cast<double>(faces.size()));
  const ContactNodes contacts(mesh, model);
  std::map<std::pair<int, int>, std::vector<int>> found;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Corners q = corners(mesh, faces[f]);
    const double shortest = shortest_side(q);
    grid.visit(Box(q, on_face * shortest), [&](int n) {
      if (hangs(mesh, n, faces[f], q, shortest) && !contacts.join(n, faces[f]))
        found[{region[n], mesh.region[owner[f]]}].push_back(n);
    });
  }
  std::vector<std::string> warnings;
  for (auto& [regions, nodes] : found) {
    sort_unique(nodes);
    const Point& p = mesh.points[nodes.front()];
    warnings.push_back(fmt::format(
        "{} nodes of region '{}' lie on faces of region '{}' of which they are no corners, first at ({:.4g}, "
        "{:.4g}, "
        "{:.4g}) mm: nothing joins the two there. Mesh them with common nodes, or describe a contact between "
        "the two "
        "surfaces.",
        nodes.size(), mesh.region_names[regions.first], mesh.region_names[regions.second], p[0], p[1], p[2]));
  }
  return warnings;
}

}  // namespace bulbus::inline problem
