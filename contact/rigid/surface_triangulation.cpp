#include "contact/rigid/surface_triangulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ranges>

#include "contact/rigid/stl.hpp"
#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/meridians.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus::inline contact {
namespace {

Vec3<double> direction(const Point& v, const std::string& key) {
  if (!(norm(v) > 0)) throw scene_error(key, "a direction is zero", "Give a vector with a length.");
  return unit(v);
}

SurfaceTriangulation surface_of(const std::vector<Quad>& faces, const std::vector<Point>& points) {
  SurfaceTriangulation surface;
  std::map<int, int> number;
  for (std::array<int, 3> t : split(faces, {points.front().data(), 3 * points.size()}).triangles) {
    for (int& corner : t) {
      const auto [entry, fresh] = number.emplace(corner, surface.size());
      if (fresh) surface.add(points[corner]);
      corner = entry->second;
    }
    surface.triangles.push_back(t);
  }
  return surface;
}

SurfaceTriangulation gmsh_body(const BodyFile& file, const std::string& key) {
  const Mesh mesh = read_gmsh(file.path);
  return surface_of(faces_of(mesh, file.surface, key), mesh.points);
}

SurfaceTriangulation stl_body(const std::string& path) {
  const StlSurface surface = read_stl(path);
  require_body(surface, path);
  return surface;
}

// A body for an eye measures some millimetres.
void warn_of_size(SurfaceTriangulation& surface, const std::string& path) {
  Point low{surface.points[0], surface.points[1], surface.points[2]}, high = low;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    low[i % 3] = std::min(low[i % 3], surface.points[i]),
            high[i % 3] = std::max(high[i % 3], surface.points[i]);
  if (const double size = norm(minus(high, low)); size < .1 || size > 1000)
    surface.warnings.push_back(
        fmt::format("{} measures {:.3g} mm from corner to corner: are its coordinates in {}? Then give "
                    "`scale: {}` beside its path.",
                    path, size, size < .1 ? "metres" : "micrometres", size < .1 ? "1000" : "0.001"));
}

}  // namespace

const std::vector<Quad>& faces_of(const Mesh& mesh, const std::string& surface, const std::string& key) {
  if (const auto found = mesh.surfaces.find(surface); found != mesh.surfaces.end() && !found->second.empty())
    return found->second;
  throw scene_error(key + ".surface", "the mesh has no surface '" + surface + "'",
                    did_you_mean(surface, std::views::keys(mesh.surfaces), "Name one of its surfaces."));
}

double enclosed_volume(std::span<const double> points, std::span<const std::array<int, 3>> triangles) {
  double six = 0;
  for (const auto& t : triangles) six += dot(at(points, t[0]), cross(at(points, t[1]), at(points, t[2])));
  return six / 6;
}

SurfaceTriangulation triangulated(const PlaneShape& plane, const std::string& key) {
  const auto [u, v] = across(direction(plane.normal, key + ".normal"));
  const double h = plane.size.value_or(usual_plane) / 2;
  SurfaceTriangulation surface;
  for (const auto& [a, b] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}})
    surface.add(plane.point + a * u + b * v);
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  return surface;
}

SurfaceTriangulation triangulated(const SphereShape& sphere) {
  const int n = sphere.facets;
  SurfaceTriangulation surface;
  std::map<std::array<int, 3>, int> number;  // lattice |i| + |j| + |k| = n
  const auto point = [&](std::array<int, 3> at) {
    const auto [entry, fresh] = number.emplace(at, surface.size());
    if (fresh)
      surface.add(sphere.center + sphere.radius * unit({double(at[0]), double(at[1]), double(at[2])}));
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto add = [&](std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
      for (auto* p : {&a, &b, &c}) *p = {sx * (*p)[0], sy * (*p)[1], sz * (*p)[2]};
      if (sx * sy * sz < 0) std::swap(b, c);
      surface.triangles.push_back({point(a), point(b), point(c)});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const int k = n - i - j;
        add({i, j, k}, {i + 1, j, k - 1}, {i, j + 1, k - 1});
        if (k > 1) add({i + 1, j, k - 1}, {i + 1, j + 1, k - 2}, {i, j + 1, k - 1});
      }
  }
  return surface;
}

SurfaceTriangulation triangulated(const RodShape& rod, const std::string& key) {
  const Vec3<double> axis = direction(rod.axis, key + ".axis");
  const auto [u, v] = across(axis);
  SurfaceTriangulation surface;
  const int below = surface.add(rod.center + (-rod.length / 2) * axis),
            above = surface.add(rod.center + (rod.length / 2) * axis);
  for (int i = 0; i < rod.facets; ++i) {
    const double phi = 2 * std::numbers::pi * i / rod.facets;
    const Vec3<double> r = rod.radius * (std::cos(phi) * u + std::sin(phi) * v);
    surface.add(rod.center + (-rod.length / 2) * axis + r);
    surface.add(rod.center + (rod.length / 2) * axis + r);
  }
  for (int i = 0; i < rod.facets; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % rod.facets);
    for (const auto& t : {std::array{a, b, b + 1}, {a, b + 1, a + 1}, {below, b, a}, {above, a + 1, b + 1}})
      surface.triangles.push_back(t);
  }
  return surface;
}

SurfaceTriangulation triangulated(const BodyFile& file, const std::string& key) {
  SurfaceTriangulation surface;
  try {
    surface =
        file.path.ends_with(".msh") || !file.surface.empty() ? gmsh_body(file, key) : stl_body(file.path);
  } catch (const InputError& fault) {  // the file's own faults know only the file
    throw InputError(fault.what(), fault.key.empty() ? key + ".path" : fault.key);
  }
  for (double& c : surface.points) c *= file.scale;
  warn_of_size(surface, file.path);
  return surface;
}

SurfaceTriangulation sweep(std::span<const Station> stations, const MeridianFrame& frame, Ends caps) {
  const int n = static_cast<int>(stations.front().profile.size()),
            strips = static_cast<int>(stations.size()) - 1;
  const bool ring = stations.back().azimuth - stations.front().azimuth >= 360 - 1e-9;
  SurfaceTriangulation surface;
  for (const Station& s : stations.first(stations.size() - ring))
    for (const auto& [axial, radial] : s.profile) surface.add(frame.place(s.azimuth, axial, radial));
  const int points = surface.size();
  // axis × radius is against the azimuth: a counter-clockwise profile looks back from the first end
  for (int k = 0; k < strips; ++k)
    for (int i = 0; i < n; ++i) {
      const int a = n * k + i, b = n * k + (i + 1) % n, c = (a + n) % points, d = (b + n) % points;
      for (const auto& t : {std::array{a, c, d}, {a, d, b}}) surface.triangles.push_back(t);
    }
  if (caps.first && !ring)
    for (const auto& [a, b, c] : triangulate(stations.front().profile))
      surface.triangles.push_back({a, b, c});
  if (caps.last && !ring)
    for (const auto& [a, b, c] : triangulate(stations.back().profile))
      surface.triangles.push_back({n * strips + a, n * strips + c, n * strips + b});
  return surface;
}

}  // namespace bulbus::inline contact
