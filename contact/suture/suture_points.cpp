#include "contact/suture/suture_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "contact/rigid/plane_section.hpp"
#include "contact/rigid/surface_triangulation.hpp"
#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/meridians.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline contact {
namespace {

using Edge = std::array<int, 2>;

SuturePoint point_of(const std::map<int, double>& weights, const Point& place) {
  SuturePoint s{.place = place};
  double sum = 0;
  for (const auto& [node, w] : weights) sum += w;
  for (const auto& [node, w] : weights) {
    s.nodes.push_back(node);
    s.weights.push_back(w / sum);
  }
  return s;
}

std::vector<int> nodes_of_set(const Mesh& mesh, const std::string& set, const std::string& key) {
  try {
    if (auto nodes = nodes_of(mesh, set); !nodes.empty()) return nodes;
  } catch (const InputError& fault) {
    throw InputError(fault.what(), key);
  }
  throw scene_error(key, "the node set '" + set + "' is empty", "Name a set with nodes.");
}

// A place may be off by what the mesh rounds off, not by more than a face is long.
void require_on(const Mesh& mesh, const std::vector<Quad>& faces, const SutureSpec& spec, std::size_t i,
                const std::string& key) {
  const Embedding e = embed(mesh, faces, spec.points[i]);
  if (e.distance <= e.size) return;
  const Point p = position(mesh, e.point);
  throw scene_error(fmt::format("{}.points.{}", key, i),
                    fmt::format("the point lies {:.3g} mm off '{}'", e.distance, spec.surface),
                    fmt::format("The nearest point on it is [{:.4g}, {:.4g}, {:.4g}].", p[0], p[1], p[2]));
}

// The curve in which a surface meets a meridian half-plane.
class Meridian {
 public:
  explicit Meridian(std::vector<CutSegment> segments) : segments_(std::move(segments)) {
    for (int s = 0; s < static_cast<int>(segments_.size()); ++s)
      for (int end = 0; end < 2; ++end) at_edge_[segments_[s].edges[end]].push_back(s);
  }

  struct Spot {
    int segment = -1;
    Point2 p{};
  };
  /// The outermost point at an axial position; segment −1 if there is none.
  Spot at(double axial) const {
    Spot best;
    for (int s = 0; s < static_cast<int>(segments_.size()); ++s) {
      const auto& [a, b] = segments_[s].ends;
      if (std::max(a[1], b[1]) <= 0 || a[0] == b[0] || (a[0] - axial) * (b[0] - axial) > 0) continue;
      const double radial = a[1] + (axial - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
      if (best.segment < 0 || radial > best.p[1]) best = {s, {axial, radial}};
    }
    return best;
  }
  /// The point at a length along the curve from a spot, through end 0 or 1 of its segment; `left` of the
  /// length lies beyond the curve's end.
  Point2 walk(Spot from, int end, double& left) const {
    for (std::size_t steps = 0; steps <= segments_.size(); ++steps) {
      const Point2& to = segments_[from.segment].ends[end];
      const double length = std::hypot(to[0] - from.p[0], to[1] - from.p[1]);
      if (left <= length) {
        const double w = length > 0 ? left / length : 0;
        left = 0;
        return {from.p[0] + w * (to[0] - from.p[0]), from.p[1] + w * (to[1] - from.p[1])};
      }
      left -= length;
      const Edge& edge = segments_[from.segment].edges[end];
      const auto& both = at_edge_.at(edge);
      if (both.size() != 2) return to;
      const int next = both[0] == from.segment ? both[1] : both[0];
      end = segments_[next].edges[0] == edge ? 1 : 0;
      from = {next, to};
    }
    return from.p;  // once around a closed curve
  }
  /// The end of a segment on the side of the smaller axial position.
  int lower_end(int segment) const {
    return segments_[segment].ends[0][0] < segments_[segment].ends[1][0] ? 0 : 1;
  }

 private:
  std::vector<CutSegment> segments_;
  std::map<Edge, std::vector<int>> at_edge_;
};

}  // namespace

std::array<Point, 2> points_on_meridian(const Mesh& mesh, const SutureSpec& spec, const std::string& key) {
  const MeridianFrame frame(spec.meridians, key);
  const Vec3<double> away = frame.radius(spec.pair->azimuth);
  const CuttingPlane plane{frame.center, cross(frame.axis, away), frame.axis, away};
  std::vector<double> places;
  for (const Point& p : mesh.points) places.insert(places.end(), p.begin(), p.end());
  const Meridian meridian(cut(places, split(faces_of(mesh, spec.surface, key)).triangles, plane));
  const auto middle = meridian.at(spec.pair->axial);
  if (middle.segment < 0)
    throw scene_error(key + ".pair",
                      "the meridian does not meet '" + spec.surface + "' at this axial position",
                      "Check azimuth, axial and surface.");
  std::array<Point, 2> points;
  const int lower = meridian.lower_end(middle.segment);
  for (int i = 0; i < 2; ++i) {
    double left = spec.pair->spacing / 2;
    points[i] = plane.lift(meridian.walk(middle, i == 0 ? lower : 1 - lower, left));
    if (left > 0)
      throw scene_error(key + ".pair.spacing",
                        "'" + spec.surface + "' ends " + std::to_string(left) + " mm before a point",
                        "Give a smaller spacing, or another position.");
  }
  return points;
}

SuturePoint bite(const Mesh& mesh, const std::vector<Quad>& faces, const Point& place, double area) {
  const EmbeddedPoint nearest = embed(mesh, faces, place).point;
  const Point middle = position(mesh, nearest);
  const double radius = std::sqrt(area / std::numbers::pi);
  std::map<int, double> weights;
  for (const Quad& q : faces) {
    const auto c = corners(mesh, q);
    const double size = std::max(norm(c[2] - c[0]), norm(c[3] - c[1]));
    if (norm(.25 * (c[0] + c[1] + c[2] + c[3]) - middle) > radius + size) continue;
    // midpoint rule with cells of a tenth of the radius
    const int m = radius > 0 ? std::clamp(static_cast<int>(std::ceil(10 * size / radius)), 1, 100) : 1;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) {
        const double s = (i + .5) / m, t = (j + .5) / m,
                     N[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
        const Point x = N[0] * c[0] + N[1] * c[1] + N[2] * c[2] + N[3] * c[3];
        if (norm(x - middle) > radius) continue;
        const Point a = mix(c[1] - c[0], c[2] - c[3], t), b = mix(c[3] - c[0], c[2] - c[1], s);
        for (int n = 0; n < 4; ++n) weights[q[n]] += N[n] * norm(cross(a, b)) / (m * m);
      }
  }
  if (weights.empty())  // the circle is smaller than the cells
    for (int n = 0; n < 4; ++n)
      if (nearest.weights[n] != 0) weights[nearest.nodes[n]] += nearest.weights[n];
  return point_of(weights, middle);
}

std::vector<SuturePoint> suture_points(const Mesh& mesh, const SutureSpec& spec,
                                       std::span<const std::string> symmetry, const std::string& key) {
  spec.validate();
  std::vector<SuturePoint> points;
  if (spec.pair)
    for (const Point& p : points_on_meridian(mesh, spec, key))
      points.push_back(bite(mesh, faces_of(mesh, spec.surface, key), p, spec.bite));
  for (std::size_t i = 0; i < spec.points.size(); ++i) {
    const auto& faces = faces_of(mesh, spec.surface, key);
    require_on(mesh, faces, spec, i, key);
    points.push_back(bite(mesh, faces, spec.points[i], spec.bite));
  }
  for (const std::string& set : spec.sets) {
    std::map<int, double> weights;
    Point mean{0, 0, 0};
    const auto nodes = nodes_of_set(mesh, set, key + ".sets");
    for (int n : nodes) {
      weights[n] = 1;
      mean = mean + 1. / static_cast<double>(nodes.size()) * mesh.points[n];
    }
    points.push_back(point_of(weights, mean));
  }
  // an embedding is exact to rounding of the projection, not of the mesh
  double size = 0;
  for (const Point& p : mesh.points) size = std::max(size, norm(p));
  if (points.size() == 2 && norm(points[0].place - points[1].place) <= 1e-6 * size)
    throw scene_error(
        key,
        fmt::format("both of its points are at ({:.4g}, {:.4g}, {:.4g}) mm: the force would act "
                    "twice there",
                    points[0].place[0], points[0].place[1], points[0].place[2]),
        "Move one of them, or leave it out.");
  for (SuturePoint& s : points)
    for (const std::string& plane : symmetry)
      if (const int c = axis_of(plane); std::abs(s.place[c]) <= 1e-6 * size) {
        s.place[c] = 0;
        s.on_plane[c] = true;
        s.share /= 2;
      }
  return points;
}

}  // namespace bulbus::inline contact
