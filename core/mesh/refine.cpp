#include "core/mesh/refine.hpp"

#include <algorithm>

#include "core/base/sort_unique.hpp"
#include "core/mesh/corners.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/hex_edges.hpp"
#include "core/mesh/sorted.hpp"

namespace bulbus::inline mesh {
namespace {

using Edge = std::array<int, 2>;

// New nodes: edges in the order of their sorted ends, then faces, then hexahedra. Two sets of nodes that rise
// together so get children that do.
class NewNodes {
 public:
  explicit NewNodes(const Mesh& mesh)
      : coarse_(static_cast<int>(mesh.points.size())), hexes_(mesh.hexes.size()) {
    edges_.reserve(12 * mesh.hexes.size());
    faces_.reserve(6 * mesh.hexes.size());
    for (const Hex& h : mesh.hexes) {
      for (const auto& e : hex_edges) edges_.push_back(sorted(Edge{h[e[0]], h[e[1]]}));
      for (const auto& f : hex_faces) faces_.push_back(sorted(Quad{h[f[0]], h[f[1]], h[f[2]], h[f[3]]}));
    }
    sort_unique(edges_);
    edges_.shrink_to_fit();
    sort_unique(faces_);
    faces_.shrink_to_fit();
  }

  int of_edge(int a, int b) const { return coarse_ + position(edges_, sorted(Edge{a, b})); }
  int of_face(const Quad& q) const { return first_face() + position(faces_, sorted(q)); }
  int of_hex(int hex) const { return first_face() + static_cast<int>(faces_.size()) + hex; }
  std::size_t count() const { return edges_.size() + faces_.size() + hexes_; }
  const std::vector<Edge>& edges() const { return edges_; }
  const std::vector<Quad>& faces() const { return faces_; }

  // The four parts of a face, each with its corner in the same place.
  std::array<Quad, 4> split(const Quad& q) const {
    const int a = of_edge(q[0], q[1]), b = of_edge(q[1], q[2]), c = of_edge(q[2], q[3]),
              d = of_edge(q[3], q[0]), m = of_face(q);
    return {{{q[0], a, m, d}, {a, q[1], b, m}, {m, b, q[2], c}, {d, m, c, q[3]}}};
  }

 private:
  int first_face() const { return coarse_ + static_cast<int>(edges_.size()); }
  template <class Key>
  static int position(const std::vector<Key>& keys, const Key& key) {
    return static_cast<int>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
  }

  int coarse_;
  std::size_t hexes_;
  std::vector<Edge> edges_;
  std::vector<Quad> faces_;
};

void take_parents(const Mesh& mesh, const NewNodes& nodes, RefinedMesh& fine) {
  fine.start.reserve(nodes.count() + 1);
  fine.parents.reserve(2 * nodes.edges().size() + 4 * nodes.faces().size() + 8 * mesh.hexes.size());
  fine.start.push_back(0);
  const auto add = [&](const auto& parents) {
    fine.parents.insert(fine.parents.end(), parents.begin(), parents.end());
    fine.start.push_back(static_cast<int>(fine.parents.size()));
  };
  for (const Edge& e : nodes.edges()) add(e);
  for (const Quad& q : nodes.faces()) add(q);
  for (const Hex& h : mesh.hexes) add(h);
}

// The 27 nodes of a refined hexahedron as a lattice, x fastest.
std::array<int, 27> lattice(const Mesh& mesh, const NewNodes& nodes, int hex) {
  const Hex& h = mesh.hexes[hex];
  std::array<int, 27> at{};
  const auto place = [](const auto& corners) {  // the lattice point amid corners
    int sum[3] = {};
    for (int c : corners)
      for (int i = 0; i < 3; ++i) sum[i] += unit_cube[c][i];
    const int n = static_cast<int>(std::size(corners));
    return 2 * sum[0] / n + 3 * (2 * sum[1] / n) + 9 * (2 * sum[2] / n);
  };
  for (int c = 0; c < 8; ++c) at[place(std::array{c})] = h[c];
  for (const auto& e : hex_edges) at[place(e)] = nodes.of_edge(h[e[0]], h[e[1]]);
  for (const auto& f : hex_faces) at[place(f)] = nodes.of_face({h[f[0]], h[f[1]], h[f[2]], h[f[3]]});
  at[13] = nodes.of_hex(hex);
  return at;
}

void split_hexes(const Mesh& mesh, const NewNodes& nodes, Mesh& fine) {
  fine.hexes.reserve(8 * mesh.hexes.size());
  fine.region.reserve(8 * mesh.hexes.size());
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h) {
    const auto at = lattice(mesh, nodes, h);
    for (const auto& child : unit_cube) {
      Hex hex;
      for (int c = 0; c < 8; ++c)
        hex[c] = at[child[0] + unit_cube[c][0] + 3 * (child[1] + unit_cube[c][1]) +
                    9 * (child[2] + unit_cube[c][2])];
      fine.hexes.push_back(hex);
      fine.region.push_back(mesh.region[h]);
    }
  }
}

// Pairwise, so that the mean of equal numbers is that number.
template <class Vector>
Vector mean(std::span<const int> parents, const std::vector<Vector>& of) {
  if (parents.size() == 1) return of[parents[0]];
  Vector a = mean(parents.first(parents.size() / 2), of);
  const Vector b = mean(parents.subspan(parents.size() / 2), of);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = .5 * (a[i] + b[i]);
  return a;
}

void place_nodes(const Mesh& mesh, const RefinedMesh& r, Mesh& fine) {
  const std::size_t count = mesh.points.size() + r.start.size() - 1;
  fine.points.reserve(count);
  fine.points.insert(fine.points.end(), mesh.points.begin(), mesh.points.end());
  if (mesh.parameters.size() == mesh.points.size()) {
    fine.parameters.reserve(count);
    fine.parameters.insert(fine.parameters.end(), mesh.parameters.begin(), mesh.parameters.end());
    fine.place = mesh.place;
  }
  for (std::size_t i = 0; i + 1 < r.start.size(); ++i) {
    const std::span<const int> parents(r.parents.data() + r.start[i], r.parents.data() + r.start[i + 1]);
    if (fine.place)
      add_node(fine, mean(parents, mesh.parameters));
    else
      fine.points.push_back(mean(parents, mesh.points));
  }
}

void split_surfaces(const Mesh& mesh, const NewNodes& nodes, Mesh& fine) {
  for (const auto& [name, faces] : mesh.surfaces) {
    auto& parts = fine.surfaces[name];
    for (const Quad& q : faces)
      for (const Quad& part : nodes.split(q)) parts.push_back(part);
  }
}

void extend_sets(const Mesh& mesh, const RefinedMesh& r, Mesh& fine) {
  fine.node_sets = mesh.node_sets;
  std::vector<bool> in(mesh.points.size());
  for (auto& [name, set] : fine.node_sets) {
    for (int n : set) in[n] = true;
    const std::vector<int> old = set;
    for (std::size_t i = 0; i + 1 < r.start.size(); ++i)
      if (std::all_of(r.parents.begin() + r.start[i], r.parents.begin() + r.start[i + 1],
                      [&](int n) { return in[n]; }))
        set.push_back(r.coarse_nodes + static_cast<int>(i));
    for (int n : old) in[n] = false;
  }
}

// The same point of the same face, in the part of it where it lies.
EmbeddedPoint in_part(const EmbeddedPoint& e, const NewNodes& nodes) {
  if (const int n = sole_node(e); n >= 0) return at_node(n);
  double xi = 2 * (e.weights[1] + e.weights[2]), eta = 2 * (e.weights[2] + e.weights[3]);
  const bool right = xi > 1, upper = eta > 1;
  xi -= right, eta -= upper;
  return {nodes.split(e.nodes)[upper ? (right ? 2 : 3) : right],
          {(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta}};
}

void move_bars(const Mesh& mesh, const NewNodes& nodes, Mesh& fine) {
  for (const auto& [name, group] : mesh.bars) {
    auto& moved = fine.bars[name];
    for (const Bar& b : group) moved.push_back({in_part(b.a, nodes), in_part(b.b, nodes), b.share});
  }
}

}  // namespace

std::vector<int> RefinedMesh::parents_of(int node) const {
  if (node < coarse_nodes) return {node};
  const int i = node - coarse_nodes;
  return {parents.begin() + start[i], parents.begin() + start[i + 1]};
}

Mesh MeshHierarchy::finest() const {
  Mesh mesh = base;
  for (int i = 0; i < refinements; ++i) mesh = refine(mesh).mesh;
  return mesh;
}

RefinedMesh refine(const Mesh& mesh) {
  RefinedMesh r;
  r.coarse_nodes = static_cast<int>(mesh.points.size());
  r.mesh.region_names = mesh.region_names;
  const NewNodes nodes(mesh);
  take_parents(mesh, nodes, r);
  split_hexes(mesh, nodes, r.mesh);
  place_nodes(mesh, r, r.mesh);
  split_surfaces(mesh, nodes, r.mesh);
  extend_sets(mesh, r, r.mesh);
  move_bars(mesh, nodes, r.mesh);
  return r;
}

}  // namespace bulbus::inline mesh
