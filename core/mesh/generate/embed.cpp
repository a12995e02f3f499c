#include "core/mesh/generate/embed.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {
namespace {

void drop_rounding(std::array<double, 4>& weights) {
  double sum = 0;
  for (double& w : weights) sum += (w = w < 1e-10 ? 0 : w);
  for (double& w : weights) w /= sum;
}

}  // namespace

Embedding embed(const Mesh& mesh, const std::vector<Quad>& faces, const Point& target) {
  if (faces.empty()) throw std::logic_error("no faces to embed a point in");
  Embedding best;
  best.distance = std::numeric_limits<double>::infinity();
  for (const Quad& q : faces) {
    const std::array<Point, 4> x = corners(mesh, q);
    const Point middle = .25 * (x[0] + x[1] + x[2] + x[3]);
    const double size = std::max(norm(x[0] - x[2]), norm(x[1] - x[3]));
    if (norm(target - middle) - size > best.distance) continue;
    const Projection p = project(target, x);
    if (p.distance < best.distance) best = {{q, p.weights}, p.distance, size};
  }
  drop_rounding(best.point.weights);
  return best;
}

Point position(const Mesh& mesh, const EmbeddedPoint& e) {
  Point x{};
  for (int i = 0; i < 4; ++i)
    if (e.weights[i] != 0) x = x + e.weights[i] * mesh.points[e.nodes[i]];
  return x;
}

int sole_node(const EmbeddedPoint& e) {
  const auto one = std::find(e.weights.begin(), e.weights.end(), 1.0);
  const bool alone = std::count(e.weights.begin(), e.weights.end(), 0.0) == 3;
  return one != e.weights.end() && alone ? e.nodes[one - e.weights.begin()] : -1;
}

EmbeddedPoint at_node(int node) { return {{node, node, node, node}, {1, 0, 0, 0}}; }

}  // namespace bulbus::inline mesh
