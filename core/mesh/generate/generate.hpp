#pragma once
#include <string>

#include "core/base/parameters.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// A box of equal cells. Region "block"; surfaces "xmin", "xmax", "ymin", "ymax", "zmin", "zmax", and
/// "outside" (all six).
struct BlockShape {
  Point lower{0, 0, 0}, upper{1, 1, 1};
  int nx = 1, ny = 1, nz = 1;
  std::string region = "block";
  template <class V>
  void describe(V&& v) {
    v("lower", lower, About{"corner with the least x, y, z", Quantity::length});
    v("upper", upper, About{"corner with the greatest x, y, z", Quantity::length});
    v("nx", nx, About{"cells in x"}.between(1, 10000));
    v("ny", ny, About{"cells in y"}.between(1, 10000));
    v("nz", nz, About{"cells in z"}.between(1, 10000));
    v("region", region, About{"name of the region"});
  }
};

/// A spherical shell about the origin, as a cubed sphere. An octant has three patches of n × n faces and
/// `layers` layers. octant: x, y, z >= 0; quarter: x, y >= 0; half: x >= 0. Surfaces "inner", "outer", and
/// "xmin", "ymin", "zmin" for the planes that cut it, on which the coordinate is exactly 0.
struct ShellShape {
  double inner = 1, outer = 2;
  int n = 4, layers = 2;
  std::string part = "octant", region = "shell";
  template <class V>
  void describe(V&& v) {
    v("inner", inner, About{"inner radius", Quantity::length}.positive());
    v("outer", outer, About{"outer radius", Quantity::length}.positive());
    v("n", n, About{"faces along 45 degrees: an octant has three patches of n x n"}.between(1, 2000));
    v("layers", layers, About{"layers through the thickness"}.between(1, 2000));
    v("part", part, About{"part of the sphere"}.one_of({"octant", "quarter", "half", "whole"}));
    v("region", region, About{"name of the region"});
  }
};

/// A solid ball about the origin: a blown-up cube of cells and `layers` shells around it. Parts as in
/// ShellShape. Surface "outer" and the cut planes.
struct BallShape {
  double radius = 1;
  int n = 4, layers = 4;
  double core = .5;
  std::string part = "octant", region = "ball";
  template <class V>
  void describe(V&& v) {
    v("radius", radius, About{"radius", Quantity::length}.positive());
    v("n", n, About{"cells of the core along half its edge"}.between(1, 1000));
    v("layers", layers, About{"shells between core and surface"}.between(1, 1000));
    v("core", core, About{"half edge of the core over the radius"}.between(.1, .7));
    v("part", part, About{"part of the ball"}.one_of({"octant", "quarter", "half", "whole"}));
    v("region", region, About{"name of the region"});
  }
};

/// A solid cylinder about the z axis from z = 0 to `height`; its section is a square core with rings around
/// it. Surfaces "bottom", "top", "side", "outside"; node set "axis".
struct CylinderShape {
  double radius = 1, height = 1;
  int n = 4, rings = 4, layers = 4;
  double core = .5;
  std::string region = "cylinder";
  template <class V>
  void describe(V&& v) {
    v("radius", radius, About{"radius", Quantity::length}.positive());
    v("height", height, About{"height", Quantity::length}.positive());
    v("n", n, About{"cells of the core along half its edge; the rim has 8 n"}.between(1, 1000));
    v("rings", rings, About{"rings between core and side"}.between(1, 1000));
    v("layers", layers, About{"layers along the axis"}.between(1, 100000));
    v("core", core, About{"half edge of the core over the radius"}.between(.1, .8));
    v("region", region, About{"name of the region"});
  }
};

/// Each throws InputError if the settings contradict each other (an upper corner below the lower one, ...).
Mesh generate(const BlockShape& shape);
Mesh generate(const ShellShape& shape);
Mesh generate(const BallShape& shape);
Mesh generate(const CylinderShape& shape);

/// Faces of the boundary for which `inside` holds at all four nodes.
template <class Predicate>
std::vector<Quad> faces_where(const Mesh& mesh, const std::vector<Quad>& faces, Predicate&& inside) {
  std::vector<Quad> chosen;
  for (const Quad& q : faces)
    if (inside(mesh.points[q[0]]) && inside(mesh.points[q[1]]) && inside(mesh.points[q[2]]) &&
        inside(mesh.points[q[3]]))
      chosen.push_back(q);
  return chosen;
}

}  // namespace bulbus::inline mesh
