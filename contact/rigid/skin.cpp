#include "contact/rigid/skin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ranges>

#include "contact/rigid/stl.hpp"
#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/meridians.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus {
namespace {

Vec3<double> direction(const Point& v, const std::string& key) {
  if (!(norm(v) > 0)) throw scene_error(key, "a direction is zero", "Give a vector with a length.");
  return unit(v);
}

Skin surface_of(const std::vector<Quad>& faces, const std::vector<Point>& points) {
  Skin skin;
  std::map<int, int> number;
  for (std::array<int, 3> t : split(faces, {points.front().data(), 3 * points.size()}).triangles) {
    for (int& corner : t) {
      const auto [entry, fresh] = number.emplace(corner, skin.size());
      if (fresh) skin.add(points[corner]);
      corner = entry->second;
    }
    skin.triangles.push_back(t);
  }
  return skin;
}

Skin gmsh_body(const BodyFile& file, const std::string& key) {
  const Mesh mesh = read_gmsh(file.path);
  return surface_of(faces_of(mesh, file.surface, key), mesh.points);
}

Skin stl_body(const std::string& path) {
  const StlSkin skin = read_stl(path);
  require_body(skin, path);
  return skin;
}

// A body for an eye measures some millimetres.
void warn_of_size(Skin& skin, const std::string& path) {
  Point low{skin.points[0], skin.points[1], skin.points[2]}, high = low;
  for (std::size_t i = 0; i < skin.points.size(); ++i)
    low[i % 3] = std::min(low[i % 3], skin.points[i]), high[i % 3] = std::max(high[i % 3], skin.points[i]);
  if (const double size = norm(minus(high, low)); size < .1 || size > 1000)
    skin.warnings.push_back(
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

Skin skin_of(const PlaneShape& plane, const std::string& key) {
  const auto [u, v] = across(direction(plane.normal, key + ".normal"));
  const double h = plane.size / 2;
  Skin skin;
  for (const auto& [a, b] : {std::pair{-h, -h}, {h, -h}, {h, h}, {-h, h}})
    skin.add(plane.point + a * u + b * v);
  skin.triangles = {{0, 1, 2}, {0, 2, 3}};
  return skin;
}

Skin skin_of(const SphereShape& sphere) {
  const int n = sphere.facets;
  Skin skin;
  std::map<std::array<int, 3>, int> number;  // lattice |i| + |j| + |k| = n
  const auto point = [&](std::array<int, 3> at) {
    const auto [entry, fresh] = number.emplace(at, skin.size());
    if (fresh) skin.add(sphere.center + sphere.radius * unit({double(at[0]), double(at[1]), double(at[2])}));
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto add = [&](std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
      for (auto* p : {&a, &b, &c}) *p = {sx * (*p)[0], sy * (*p)[1], sz * (*p)[2]};
      if (sx * sy * sz < 0) std::swap(b, c);
      skin.triangles.push_back({point(a), point(b), point(c)});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const int k = n - i - j;
        add({i, j, k}, {i + 1, j, k - 1}, {i, j + 1, k - 1});
        if (k > 1) add({i + 1, j, k - 1}, {i + 1, j + 1, k - 2}, {i, j + 1, k - 1});
      }
  }
  return skin;
}

Skin skin_of(const RodShape& rod, const std::string& key) {
  const Vec3<double> axis = direction(rod.axis, key + ".axis");
  const auto [u, v] = across(axis);
  Skin skin;
  const int below = skin.add(rod.center + (-rod.length / 2) * axis),
            above = skin.add(rod.center + (rod.length / 2) * axis);
  for (int i = 0; i < rod.facets; ++i) {
    const double phi = 2 * std::numbers::pi * i / rod.facets;
    const Vec3<double> r = rod.radius * (std::cos(phi) * u + std::sin(phi) * v);
    skin.add(rod.center + (-rod.length / 2) * axis + r);
    skin.add(rod.center + (rod.length / 2) * axis + r);
  }
  for (int i = 0; i < rod.facets; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % rod.facets);
    for (const auto& t : {std::array{a, b, b + 1}, {a, b + 1, a + 1}, {below, b, a}, {above, a + 1, b + 1}})
      skin.triangles.push_back(t);
  }
  return skin;
}

Skin skin_of(const BodyFile& file, const std::string& key) {
  Skin skin;
  try {
    skin = file.path.ends_with(".msh") || !file.surface.empty() ? gmsh_body(file, key) : stl_body(file.path);
  } catch (const InputError& fault) {  // the file's own faults know only the file
    throw InputError(fault.what(), fault.key.empty() ? key + ".path" : fault.key);
  }
  for (double& c : skin.points) c *= file.scale;
  warn_of_size(skin, file.path);
  return skin;
}

Skin sweep(std::span<const Station> stations, const MeridianFrame& frame, bool caps) {
  const int n = static_cast<int>(stations.front().section.size()),
            strips = static_cast<int>(stations.size()) - 1;
  const bool ring = stations.back().azimuth - stations.front().azimuth >= 360 - 1e-9;
  Skin skin;
  for (const Station& s : stations.first(stations.size() - ring))
    for (const auto& [axial, radial] : s.section) skin.add(frame.place(s.azimuth, axial, radial));
  const int points = skin.size();
  // axis × radius is against the azimuth: a counter-clockwise section looks back from the first end
  for (int k = 0; k < strips; ++k)
    for (int i = 0; i < n; ++i) {
      const int a = n * k + i, b = n * k + (i + 1) % n, c = (a + n) % points, d = (b + n) % points;
      for (const auto& t : {std::array{a, c, d}, {a, d, b}}) skin.triangles.push_back(t);
    }
  if (!caps || ring) return skin;
  for (const auto& [a, b, c] : triangulate(stations.front().section)) skin.triangles.push_back({a, b, c});
  for (const auto& [a, b, c] : triangulate(stations.back().section))
    skin.triangles.push_back({n * strips + a, n * strips + c, n * strips + b});
  return skin;
}

}  // namespace bulbus
