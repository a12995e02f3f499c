#include "core/problem/surface_sides.hpp"

#include <algorithm>
#include <iterator>

#include "core/mesh/faces.hpp"

namespace bulbus::inline problem {

std::size_t SurfaceSides::Hash::operator()(const Quad& q) const {
  std::size_t h = 0;
  for (int n : q) h = h * 1000003u + static_cast<std::size_t>(n);
  return h;
}

SurfaceSides::SurfaceSides(const Mesh& mesh, const std::set<std::string>& surfaces) {
  std::vector<bool> on(mesh.points.size());
  for (const std::string& name : surfaces)
    for (const Quad& q : mesh.surfaces.at(name)) {
      regions_.emplace(sorted(q), std::array{-1, -1});
      for (int n : q) on[n] = true;
    }
  if (regions_.empty()) return;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (std::ranges::count_if(mesh.hexes[h], [&](int n) { return on[n]; }) < 4) continue;
    for (int f = 0; f < 6; ++f)
      if (const auto found = regions_.find(sorted(face_nodes(mesh.hexes, static_cast<int>(6 * h + f))));
          found != regions_.end())
        found->second[found->second[0] < 0 ? 0 : 1] = mesh.region[h];
  }
}

int common_faces(const Mesh& mesh, const std::string& a, const std::string& b) {
  const auto keys = [&](const std::string& name) {
    std::vector<Quad> faces = mesh.surfaces.at(name);
    for (Quad& q : faces) q = sorted(q);
    return sorted(faces);
  };
  std::vector<Quad> common;
  std::ranges::set_intersection(keys(a), keys(b), std::back_inserter(common));
  return static_cast<int>(common.size());
}

}  // namespace bulbus::inline problem
