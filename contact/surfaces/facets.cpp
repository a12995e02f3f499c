#include "contact/surfaces/facets.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"

namespace bulbus::inline contact {

Triangle corners_of(const Facets& facets, std::span<const double> places, int triangle) {
  Triangle c;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) c[i][k] = places[3 * facets.triangles[triangle][i] + k];
  return c;
}

Facets make_facets(std::vector<std::array<int, 3>> triangles, std::span<const double> points) {
  Facets f{std::move(triangles), {}};
  f.neighbours.assign(f.triangles.size(), {-1, -1, -1});
  std::map<std::array<int, 2>, std::array<int, 2>> open;  // directed edge → triangle and the corner opposite
  const auto place = [&](int p) {
    return 3 * static_cast<std::size_t>(p) + 3 > points.size()
               ? fmt::format("point {}", p + 1)
               : fmt::format("({:.4g}, {:.4g}, {:.4g})", points[3 * p], points[3 * p + 1], points[3 * p + 2]);
  };
  for (int t = 0; t < static_cast<int>(f.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = f.triangles[t][(i + 1) % 3], b = f.triangles[t][(i + 2) % 3];
      if (!open.insert({{a, b}, {t, i}}).second)
        throw input_error(
            "surface: the edge from " + place(a) + " to " + place(b) + " is used twice in one direction",
            "Turn its triangles so that all normals point out, and let no edge have three.");
    }
  for (const auto& [edge, at] : open)
    if (const auto other = open.find({edge[1], edge[0]}); other != open.end())
      f.neighbours[at[0]][at[1]] = other->second[0];
  return f;
}

std::vector<std::array<int, 3>> triangles_of(std::span<const Quad> quads) {
  std::vector<std::array<int, 3>> triangles;
  for (const Quad& q : quads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

Facets split(std::span<const Quad> quads, std::span<const double> points) {
  return make_facets(triangles_of(quads), points);
}

}  // namespace bulbus::inline contact
