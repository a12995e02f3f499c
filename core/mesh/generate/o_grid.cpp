#include "core/mesh/generate/o_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bulbus::inline mesh {
namespace {

/// Equiangular lattice: tan(45° i / n), exact at −n, 0, n.
double tangent(double i, int n) { return std::abs(i) == n ? i / n : std::tan(std::numbers::pi / 4 * i / n); }

/// Lattice points of the core's outline in the order of Disc::rim.
std::vector<std::array<int, 2>> outline(int n, bool half) {
  std::vector<std::array<int, 2>> l;
  if (half) {
    for (int i = 0; i < n; ++i) l.push_back({i, n});
    for (int j = n; j > -n; --j) l.push_back({n, j});
    for (int i = n; i >= 0; --i) l.push_back({i, -n});
  } else {
    for (int j = -n; j < n; ++j) l.push_back({n, j});
    for (int i = n; i > -n; --i) l.push_back({i, n});
    for (int j = n; j > -n; --j) l.push_back({-n, j});
    for (int i = -n; i < n; ++i) l.push_back({i, -n});
  }
  return l;
}

Disc::Node node_at(const DiscMap& map, int i, int j, int ring) { return {map(i, j, ring), i, j, ring}; }

void add_core(Disc& disc, const DiscMap& map, bool half) {
  const int n = map.n;
  const int low = half ? 0 : -n, width = n - low + 1;
  for (int j = -n; j <= n; ++j)
    for (int i = low; i <= n; ++i) disc.nodes.push_back(node_at(map, i, j, 0));
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i + 1 < width; ++i) {
      const int a = i + width * j;
      disc.quads.push_back({a, a + 1, a + 1 + width, a + width});
    }
  disc.rim.clear();
  for (const auto& [i, j] : outline(n, half)) disc.rim.push_back(i - low + width * (j + n));
}

void add_ring(Disc& disc, const DiscMap& map, int ring, bool half) {
  const int m = static_cast<int>(disc.rim.size());
  std::vector<int> next;
  for (int k : disc.rim) {
    next.push_back(static_cast<int>(disc.nodes.size()));
    disc.nodes.push_back(node_at(map, disc.nodes[k].i, disc.nodes[k].j, ring));
  }
  for (int k = 0; k < (half ? m - 1 : m); ++k) {
    const int l = (k + 1) % m;
    if (half)
      disc.quads.push_back({disc.rim[k], disc.rim[l], next[l], next[k]});
    else
      disc.quads.push_back({disc.rim[k], next[k], next[l], disc.rim[l]});
  }
  disc.rim = next;
}

}  // namespace

DiscMap::Place DiscMap::operator()(double i, double j, double ring) const {
  const double x = tangent(i, n), y = tangent(j, n), r = std::hypot(x, y);
  if (r == 0) return {0, 0, 1};
  const double q = std::max(std::abs(x), std::abs(y));
  // Square (r) towards circle (q), half way at the outline: three angles of about 120° meet at its corners.
  const double inner = core * ((1 - .5 * q) * r + .5 * q * q);
  return {ring == 0 ? inner : ring == rings ? 1 : inner + (1 - inner) * ring / rings, x / r, y / r};
}

Disc o_grid(const DiscMap& map, bool half) {
  Disc disc;
  add_core(disc, map, half);
  for (int ring = 1; ring <= map.rings; ++ring) add_ring(disc, map, ring, half);
  return disc;
}

}  // namespace bulbus::inline mesh
