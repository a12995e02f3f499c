#pragma once
#include <memory>
#include <span>

#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/pair.hpp"
#include "contact/surfaces/smoothed_facets.hpp"

namespace bulbus::inline contact {

/// Spheres around the triangles of a surface, about their centroids.
struct EnclosingSpheres {
  struct Sphere {
    Vec3<double> center;
    double radius;
  };
  EnclosingSpheres(const Facets& facets, std::span<const double> places);
  std::vector<Sphere> of_each;
  double largest_radius = 0;
};

/// A master surface where it is now. Numbers of triangles are the same on every rank: they break ties.
struct MasterSurface {
  /// `normals`: of a curved surface that the triangles stand for; empty: they are flat. `spheres`: of a
  /// surface that has not moved since they were found; none: found here. The surface must stay, its places
  /// and normals too, or be those of `shape`.
  MasterSurface(const Facets& facets, std::span<const double> places,
                std::span<const CornerNormals> normals = {},
                std::shared_ptr<const EnclosingSpheres> spheres = nullptr);
  Triangle corners(int triangle) const { return corners_of(facets, places, triangle); }
  const EnclosingSpheres::Sphere& sphere(int triangle) const { return spheres->of_each[triangle]; }

  const Facets& facets;
  std::span<const double> places;
  std::span<const CornerNormals> normals;
  bool edges = true;  ///< triangles whose planes differ by more than 30 degrees do not share their normals
  double rim = 0.01;  ///< how far a triangle reaches past an edge without a neighbour, in its heights
  std::shared_ptr<const EnclosingSpheres> spheres;
  std::shared_ptr<const void> shape;  ///< what places and normals are part of, if nobody else keeps it
};

/// Where the line x + d N meets a triangle's plane. With A = x1 − x, B = x2 − x, C = x3 − x the weights of
/// the meeting point are
///     w1 = N·(B×C), w2 = N·(C×A), w3 = N·(A×B) over their sum, and d = A·(B×C) over it
struct Crossing {
  bool facing = false;  ///< N·n < 0: the triangle looks at the slave; nothing else is given if not
  std::array<double, 3> weights;
  double distance;  ///< d; negative where the node is behind the plane
  /// Edges belong to both sides. A rim, where `neighbours` of the triangle are −1, reaches past itself by the
  /// part `rim` of its height.
  bool inside(const std::array<int, 3>& neighbours = {}, double rim = 0) const;
};
Crossing cross_line(const Vec3<double>& x, const Vec3<double>& N, const Triangle& corners);

/// Walks from `start` towards the triangle that the line meets: across the edge opposite the most negative
/// weight. −1 at a rim (but for what it reaches past itself), at a triangle that looks away, or after 20
/// steps.
int track(const MasterSurface& master, const Vec3<double>& x, const Vec3<double>& N, int start);

/// Of a curved surface: walks from `start` to the triangle in which x has its projection along the
/// interpolated normals (project_along_normals), or as near to it as a walk across smooth edges (planes
/// within 30 degrees) leads.
int triangle_of_projection(const MasterSurface& master, const Vec3<double>& x, int start);

struct SearchLimits {
  double depth;  ///< a node deeper than this behind a triangle is on another side of the body, mm
  double reach;  ///< farthest place of the surface that counts, along the line or straight, mm
};

struct Selection {
  int triangle = -1;  ///< −1: none, the node is free
  double distance;    ///< to the surface, as far as known; reach if nothing is near
};

/// The triangle whose plane keeps the node out.
/// 1. The one that the slave's normal line meets: found by tracking from `start` (−1: none), on whose right
/// side the node is
///    known to have been, so that `depth` does not count; otherwise the nearest one among the candidates.
/// 2. Where the line meets none, or only one that the node is in front of, the node may still be inside: in a
/// concave corner, or
///    where the line slips past a rim. The nearest point of the surface decides, behind an edge or a corner
///    by the sum of the normals around it (angle-weighted). A rim stops nothing that it does not reach.
/// `candidates`: ascending; all triangles within reach of x.
Selection select(const MasterSurface& master, const Vec3<double>& x, const Vec3<double>& N, int start,
                 std::span<const int> candidates, const SearchLimits& limits);

}  // namespace bulbus::inline contact
