#pragma once
#include "contact/surfaces/slave_surface.hpp"

namespace bulbus::inline contact {

/// The places of a slave surface that a contact keeps out of its master, carried by nodes: x = Σ w_i x_i.
/// Either the owned nodes themselves, or m × m points spread evenly over each face (the midpoints of its m ×
/// m parts), which feel edges of the master that are finer than the mesh and let go of them little by little.
class SlavePoints {
 public:
  struct Point {
    std::array<int, 4> nodes;  ///< local
    std::array<double, 4> weights;
    int carriers;  ///< how many of the four
    bool mine;  ///< this rank gives its force; points of others' faces are followed so that the owned nodes'
                ///< sums are whole
    double chordal_offset;  ///< how far the curved surface that the faces stand for is outside of x, mm
  };

  /// `divisions`: m; 0: the nodes. Faces with a node in `excluded` (ascending) have no points.
  SlavePoints(const SlaveSurface& surface, int owned, std::span<const int> excluded, int divisions);
  /// Lets the points stand for the curved surface whose normals n_i at the nodes are the means over the faces
  /// (`all` of the surface):
  ///     chordal offset = ½ Σ w_i n_i·(X_i − X),  of second order exact on a circle
  /// A face with a corner where the normals differ by more than 30 degrees stays flat.
  void chordal_offset(std::span<const double> X, std::span<const Quad> all,
                      std::span<const std::string> symmetry);

  int size() const { return static_cast<int>(points_.size()); }
  /// Of each point a number that is its own on every rank, provided that all faces of the surface were given
  /// in the same order.
  std::vector<long long> keys(const SlaveSurface& surface) const;
  const Point& operator[](int i) const { return points_[i]; }
  /// 3 per point, mm.
  std::vector<double> places(std::span<const double> x) const;
  /// What a gradient m at x + chordal offset N is to the carriers: ∂(m·(x + chordal offset N))/∂x_i, m held.
  std::array<Vec3<double>, 4> shares(int i, std::span<const double> x, const Vec3<double>& m) const;
  bool on_faces() const { return divisions_ > 0; }
  /// Points of one face, which follow one another; 1 where they are the nodes.
  int of_a_face() const { return on_faces() ? divisions_ * divisions_ : 1; }
  /// Normals and areas of points on faces; those of the nodes are the surface's.
  SlaveSurface::Shape shape(std::span<const double> x) const;

 private:
  struct Tangents {
    std::array<double, 4> xi, eta;  // derivatives of the weights
    Vec3<double> a, b;              // ∂x/∂ξ, ∂x/∂η
  };
  Tangents tangents(const Point& p, std::span<const double> x) const;

  int divisions_;
  std::vector<Point> points_;
};

}  // namespace bulbus::inline contact
