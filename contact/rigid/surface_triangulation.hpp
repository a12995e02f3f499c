#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "contact/rigid/profile.hpp"
#include "contact/surfaces/meridians.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// Points and triangles of a surface; (x2 − x1) × (x3 − x1) points out of the body.
struct SurfaceTriangulation {
  std::vector<double> points;  ///< 3 per point, mm
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::string> warnings;  ///< sentences about the file that it was read from

  int size() const { return static_cast<int>(points.size() / 3); }
  /// Returns the number of the new point.
  int add(const Point& p) {
    for (double c : p) points.push_back(c);
    return size() - 1;
  }
};

/// ⅙ Σ x1·(x2 × x3), mm³: the volume if the surface is closed, negative if it is inside out.
double enclosed_volume(std::span<const double> points, std::span<const std::array<int, 3>> triangles);

/// A surface of a mesh. Throws InputError that blames `key`.surface, with the nearest name, if there is none.
const std::vector<Quad>& faces_of(const Mesh& mesh, const std::string& surface, const std::string& key);

SurfaceTriangulation triangulated(const PlaneShape& shape, const std::string& key);
/// An octahedron whose faces are cut into facets² triangles, blown up: corners lie on the sphere.
SurfaceTriangulation triangulated(const SphereShape& shape);
SurfaceTriangulation triangulated(const RodShape& shape, const std::string& key);
SurfaceTriangulation triangulated(const BodyFile& file, const std::string& key);

/// the profile of an arc at an azimuth, degrees.
struct Station {
  double azimuth;
  Profile profile;
};

/// Which ends of an arc something is true of.
struct Ends {
  bool first = false, last = false;
  int count() const { return first + last; }
};

/// The surface through sections of equally many corners at ascending azimuths; closed by flat `caps`.
/// If the last azimuth is a whole turn beyond the first, the surface ends where it begins.
SurfaceTriangulation sweep(std::span<const Station> stations, const MeridianFrame& frame, Ends caps);

}  // namespace bulbus::inline contact
