#pragma once
#include <functional>
#include <memory>

#include "contact/law/contact_term.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {

/// Nodes and faces of sheets one after another: surfaces without bodies behind them.
struct Sheets {
  std::vector<double> X;

  int nodes() const { return static_cast<int>(X.size() / 3); }
  /// n × m faces of a map from the unit square; normals along ∂/∂u × ∂/∂v.
  std::vector<Quad> add(int n, int m, const std::function<Vec3<double>(double, double)>& place) {
    const int first = nodes();
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= n; ++i)
        for (double v : place(double(i) / n, double(j) / m)) X.push_back(v);
    std::vector<Quad> faces;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = first + j * (n + 1) + i;
        faces.push_back({a, a + 1, a + n + 2, a + n + 1});
      }
    return faces;
  }
  State state() const { return {X, {}, {}, {}}; }
};

/// A prism over a convex polygon in x and z (counter-clockwise seen along −y), between y = ±½ length. Closed.
inline std::shared_ptr<RigidSurface> prism(const std::vector<std::array<double, 2>>& outline, double length) {
  auto s = std::make_shared<RigidSurface>();
  const int n = static_cast<int>(outline.size());
  for (double y : {-length / 2, length / 2})
    for (const auto& p : outline) s->reference.insert(s->reference.end(), {p[0], y, p[1]});
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    triangles.push_back({i, j, n + j});
    triangles.push_back({i, n + j, n + i});
    if (i > 0 && j > 0) triangles.push_back({0, j, i}), triangles.push_back({n, n + i, n + j});
  }
  for (auto& t : triangles) std::swap(t[1], t[2]);
  s->facets = make_facets(triangles);
  s->places = s->reference;
  s->parts = {{.first_point = 0,
               .points = 2 * n,
               .first_triangle = 0,
               .triangles = static_cast<int>(triangles.size())}};
  return s;
}

/// Box of half widths a, h in x, z.
inline std::shared_ptr<RigidSurface> box(double a, double h, double length) {
  return prism({{a, -h}, {a, h}, {-a, h}, {-a, -h}}, length);
}

inline std::shared_ptr<RigidSurface> cylinder(int sides, double radius, double length) {
  std::vector<std::array<double, 2>> outline;
  for (int i = 0; i < sides; ++i)
    outline.push_back({radius * std::cos(2 * M_PI * i / sides), radius * std::sin(2 * M_PI * i / sides)});
  return prism(outline, length);
}

inline ContactSpec contact_spec(double penalty, double depth, double tolerance = 0) {
  ContactSpec s;
  s.penalty = penalty, s.depth = depth, s.tolerance = tolerance;
  return s;
}

}  // namespace bulbus
