#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {
namespace {

using Lattice = std::array<int, 3>;

/// A cube of lattice points −n..n (or 0..n where a plane cuts) in each direction.
struct Cube {
  int n;
  Lattice low;

  Cube(int n, const std::string& part) : n(n), low{-n, -n, -n} {
    const int cuts = part == "octant" ? 3 : part == "quarter" ? 2 : part == "half" ? 1 : 0;
    for (int i = 0; i < cuts; ++i) low[i] = 0;
  }

  /// Equiangular: tan(45° i / n) in each direction; exact at −n, 0, n.
  Point tangent(const Parameters& l) const {
    Point p;
    for (int i = 0; i < 3; ++i)
      p[i] = std::abs(l[i]) == n ? l[i] / n : std::tan(std::numbers::pi / 4 * l[i] / n);
    return p;
  }

  /// Calls visit(four lattice points, normals outwards) for the cube's faces that lie on the sphere's side.
  template <class Visit>
  void patches(Visit&& visit) const {
    for (int axis = 0; axis < 3; ++axis)
      for (int side = low[axis] == 0 ? 1 : -1; side <= 1; side += 2) patch(axis, side, visit);
  }

 private:
  template <class Visit>
  void patch(int axis, int side, Visit&& visit) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int j = low[v]; j < n; ++j)
      for (int i = low[u]; i < n; ++i) {
        std::array<Lattice, 4> q;
        const int di[4] = {0, 1, 1, 0}, dj[4] = {0, 0, 1, 1};
        for (int c = 0; c < 4; ++c) {
          Lattice& l = q[side > 0 ? c : 3 - c];
          l[axis] = side * n;
          l[u] = i + di[c];
          l[v] = j + dj[c];
        }
        visit(q);
      }
  }
};

/// Nodes by lattice point and shell; shell 0 is the core. Their parameters are these four numbers.
class Nodes {
 public:
  explicit Nodes(Mesh& mesh) : mesh_(mesh) {}

  int operator()(const Lattice& l, int shell) {
    const auto [at, fresh] = ids_.try_emplace({l[0], l[1], l[2], shell}, 0);
    if (fresh) at->second = add_node(mesh_, {double(l[0]), double(l[1]), double(l[2]), double(shell)});
    return at->second;
  }

 private:
  Mesh& mesh_;
  std::map<std::array<int, 4>, int> ids_;
};

void add_shells(Mesh& mesh, const Cube& cube, Nodes& nodes, int layers) {
  cube.patches([&](const std::array<Lattice, 4>& q) {
    for (int s = 0; s < layers; ++s) {
      Hex h;
      for (int c = 0; c < 4; ++c) {
        h[c] = nodes(q[c], s);
        h[c + 4] = nodes(q[c], s + 1);
      }
      mesh.hexes.push_back(h);
    }
  });
}

void add_core(Mesh& mesh, const Cube& cube, Nodes& nodes) {
  for (int k = cube.low[2]; k < cube.n; ++k)
    for (int j = cube.low[1]; j < cube.n; ++j)
      for (int i = cube.low[0]; i < cube.n; ++i) {
        const int di[4] = {0, 1, 1, 0}, dj[4] = {0, 0, 1, 1};
        Hex h;
        for (int c = 0; c < 8; ++c) h[c] = nodes({i + di[c % 4], j + dj[c % 4], k + c / 4}, 0);
        mesh.hexes.push_back(h);
      }
}

/// Cut planes and the parts of the sphere's side of the boundary that lie beyond or within `radius`.
void name_faces(Mesh& mesh, const Cube& cube, const std::string& region, double radius, bool hollow) {
  mesh.region.assign(mesh.hexes.size(), 0);
  mesh.region_names = {region};
  for (const Quad& q : boundary_faces(mesh)) {
    const std::array<Point, 4> x = corners(mesh, q);
    const auto on = [&](int i) {
      return cube.low[i] == 0 && x[0][i] == 0 && x[1][i] == 0 && x[2][i] == 0 && x[3][i] == 0;
    };
    if (on(0))
      mesh.surfaces["xmin"].push_back(q);
    else if (on(1))
      mesh.surfaces["ymin"].push_back(q);
    else if (on(2))
      mesh.surfaces["zmin"].push_back(q);
    else
      mesh.surfaces[hollow && norm(x[0]) < radius ? "inner" : "outer"].push_back(q);
  }
}

}  // namespace

Mesh generate(const ShellShape& s) {
  if (!(s.inner < s.outer))
    throw input_error("shell: the inner radius is not below the outer one", "give 0 < inner < outer");
  Mesh mesh;
  const Cube cube(s.n, s.part);
  mesh.place = [s, cube](const Parameters& p) {
    const Point t = cube.tangent(p);
    const double r = p[3] == s.layers ? s.outer : s.inner + (s.outer - s.inner) * p[3] / s.layers;
    return r / norm(t) * t;
  };
  Nodes nodes(mesh);
  add_shells(mesh, cube, nodes, s.layers);
  name_faces(mesh, cube, s.region, .5 * (s.inner + s.outer), true);
  return mesh;
}

Mesh generate(const BallShape& b) {
  Mesh mesh;
  const Cube cube(b.n, b.part);
  mesh.place = [b, cube](const Parameters& p) {
    const Point t = cube.tangent(p);
    const double size = norm(t);
    if (size == 0) return t;
    const double q = std::max({std::abs(t[0]), std::abs(t[1]), std::abs(t[2])});
    // Between cube and sphere, half way at the core's surface: its corners open and the shells' cells stay
    // regular.
    const Point core = b.radius * b.core * (1 - .5 * q + .5 * q * q / size) * t;
    return mix(core, b.radius / size * t, p[3] / b.layers);
  };
  Nodes nodes(mesh);
  add_core(mesh, cube, nodes);
  add_shells(mesh, cube, nodes, b.layers);
  name_faces(mesh, cube, b.region, 0, false);
  return mesh;
}

}  // namespace bulbus::inline mesh
