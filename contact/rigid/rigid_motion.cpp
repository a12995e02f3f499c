#include "contact/rigid/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surfaces/meridians.hpp"
#include "core/base/error.hpp"
#include "core/problem/rigid_body.hpp"

namespace bulbus::inline contact {
namespace {

// Between a part brought to touch and the first of its slave's points: of the slave's extent, and mm at most.
constexpr double near_touch = 1e-7, farthest_touch = 1e-6;

constexpr double looks_away = 1e-6;  // N·d

double clearance(std::span<const double> points) {
  double extent = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = c; i < points.size(); i += 3)
      extent = std::max(extent, std::abs(points[i] - points[c]));
  return extent > 0 ? std::min(near_touch * extent, farthest_touch) : farthest_touch;
}

// The points that a body on its way along d meets from in front: N·d ≤ 0 but for rounding.
std::vector<double> opposed(const SlavePlaces& slaves, const Vec3<double>& d) {
  if (slaves.normals.empty()) return slaves.points;
  std::vector<double> points;
  for (std::size_t i = 0; i < slaves.points.size(); i += 3)
    if (dot({slaves.normals[i], slaves.normals[i + 1], slaves.normals[i + 2]}, d) <= looks_away)
      points.insert(points.end(), &slaves.points[i], &slaves.points[i] + 3);
  return points;
}

// What a surface is known by: triangles, corners, and how far these lie from the origin together.
std::vector<double> figures_of(const RigidSurface& surface) {
  double far = 0;
  for (double v : surface.reference) far += std::abs(v);
  return {1. * surface.facets.triangles.size(), surface.reference.size() / 3., far};
}

bool alike(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(
      a, b, [](double v, double w) { return std::abs(v - w) <= 1e-9 * std::max(std::abs(v), std::abs(w)); });
}

Vec3<double> turned(const Mat3<double>& R, const Vec3<double>& v) {
  return {R(0, 0) * v[0] + R(0, 1) * v[1] + R(0, 2) * v[2], R(1, 0) * v[0] + R(1, 1) * v[1] + R(1, 2) * v[2],
          R(2, 0) * v[0] + R(2, 1) * v[1] + R(2, 2) * v[2]};
}

// A frame that looks along the direction: two coordinates across it and the way along it.
struct View {
  Vec3<double> u, v, d;
  explicit View(const Vec3<double>& direction)
      : u(across(direction)[0]), v(across(direction)[1]), d(direction) {}
  Vec3<double> operator()(const double* x) const {
    const Vec3<double> p{x[0], x[1], x[2]};
    return {dot(u, p), dot(v, p), dot(d, p)};
  }
  Vec3<double> back(const Vec3<double>& p) const { return p[0] * u + p[1] * v + p[2] * d; }
};

double area2(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// The way to the curved surface that a facet stands for, by Newton's method from that to the facet: a motion
// of the facet along d is one of the point x against it.
double way_to_curve(const Vec3<double>& x, const Vec3<double>& d, const Triangle& corners,
                    const CornerNormals& normals, double to_facet) {
  double way = to_facet;
  for (int k = 0; k < 5; ++k) {
    const Vec3<double> y = x - way * d;
    const FaceGap at = smoothed_gap(y, project(y, corners), corners, normals);
    const double slope = dot(at.normal, d);
    if (!(slope > 1e-3)) return to_facet;  // grazes the surface
    way += at.gap / slope;
  }
  return way;
}

}  // namespace

double way_to_touch(const RigidSurface& surface, const RigidSurface::Part& part,
                    const Vec3<double>& direction, std::span<const double> points) {
  const View view(direction);
  std::vector<Vec3<double>> seen;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3) seen.push_back(view(&points[i]));
  std::ranges::sort(seen, {}, [](const Vec3<double>& p) { return p[0]; });
  double way = std::numeric_limits<double>::infinity();
  for (int t = part.first_triangle; t < part.first_triangle + part.triangles; ++t) {
    std::array<Vec3<double>, 3> c;
    for (int i = 0; i < 3; ++i) c[i] = view(&surface.places[3 * surface.facets.triangles[t][i]]);
    const double area = area2(c[0], c[1], c[2]);
    const auto [low, high] = std::minmax({c[0][0], c[1][0], c[2][0]});
    const auto [bottom, top] = std::minmax({c[0][1], c[1][1], c[2][1]});
    const double size = std::max(high - low, top - bottom), slack = 1e-12 * size * size;
    if (area <= slack) continue;  // only facets that face the way meet anything first
    for (auto p = std::ranges::lower_bound(seen, low - 1e-12 * size, {},
                                           [](const Vec3<double>& q) { return q[0]; });
         p != seen.end() && (*p)[0] <= high + 1e-12 * size; ++p) {
      const double a = area2(*p, c[1], c[2]), b = area2(c[0], *p, c[2]), e = area - a - b;
      if (a < -slack || b < -slack || e < -slack) continue;
      double here = (*p)[2] - (a * c[0][2] + b * c[1][2] + e * c[2][2]) / area;
      if (!surface.normals.empty() && here - size < way)
        here = way_to_curve(view.back(*p), direction, {view.back(c[0]), view.back(c[1]), view.back(c[2])},
                            surface.normals[t], here);
      way = std::min(way, here);
    }
  }
  return way;
}

RigidMotion::RigidMotion(std::shared_ptr<RigidSurface> surface)
    : surface_(std::move(surface)), start_(surface_->parts.size()), now_(start_) {
  place();
}

void RigidMotion::set_poses(std::vector<Pose> poses) {
  start_ = now_ = std::move(poses);
  course_ = {};
  place();
}

Vec3<double> RigidMotion::inwards(std::size_t part) const {
  return turned(start_[part].rotation, surface_->parts[part].inwards);
}

void RigidMotion::begin(const MoveSpec& move, const SlavePlaces& slaves, const std::string& key) {
  const double close = move.close + move.shorten / surface_->shortening;
  for (const auto& part : surface_->parts)
    if (close != 0 && norm(part.inwards) == 0)
      throw scene_error(key + (move.close != 0 ? ".close" : ".shorten"),
                        "'" + surface_->name + "' has no direction to close along",
                        "Give the body a `direction`, or use `translate`.");
  if (move.close != 0 && move.shorten != 0)
    throw scene_error(key + ".shorten", "`close` and `shorten` both say how far the body closes",
                      "Keep one of them.");
  if (move.rotate && !(norm(move.rotate->axis) > 0))
    throw scene_error(key + ".rotate.axis", "the axis is zero", "Give a vector with a length.");
  if (move.from == "touch") bring_to_touch(move, slaves, key);
  course_ = {move.rotate, move.translate, close};
  set_progress(0);
}

void RigidMotion::bring_to_touch(const MoveSpec& move, const SlavePlaces& slaves, const std::string& key) {
  now_ = start_;
  place();  // where a run goes on amid the step it is farther on
  const double left = clearance(slaves.points);
  for (std::size_t p = 0; p < start_.size(); ++p) {
    const bool shifts = move.close == 0 && move.shorten == 0 && norm(move.translate) > 0;
    const Vec3<double> d = shifts ? unit(move.translate) : inwards(p);
    if (!(norm(d) > 0))
      throw scene_error(key + ".from", "'" + surface_->name + "' has no direction in which to come to touch",
                        "Give the move a `translate`, or the body a `direction`.");
    const double way = way_to_touch(*surface_, surface_->parts[p], d, opposed(slaves, d));
    if (!std::isfinite(way))
      throw scene_error(
          key + ".from",
          "part " + std::to_string(p) + " of '" + surface_->name +
              "' meets no node of the surfaces it is in contact with" +
              (std::isfinite(way_to_touch(*surface_, surface_->parts[p], d, slaves.points))
                   ? " but from behind: where it meets them they look the way that it moves"
                   : ""),
          "Place the body so that its way leads to them, and name them as slaves of a contact with it.");
    start_[p].shift = start_[p].shift + (way - left) * d;
  }
}

Pose RigidMotion::at(std::size_t part, double s) const {
  Pose pose = start_[part];
  const Vec3<double>& c = surface_->parts[part].center;
  if (course_.rotate) {
    const RotationSpec& r = *course_.rotate;
    const Mat3<double> R = rotation(s * r.angle * unit(r.axis));
    pose.rotation = R * pose.rotation;
    pose.shift = r.center + turned(R, c + pose.shift - r.center) - c;
  }
  pose.shift = pose.shift + s * course_.translate + (s * course_.close + closing_) * inwards(part);
  return pose;
}

void RigidMotion::set_closing(double way) {
  closing_ = way;
  set_progress(progress_);
}

void RigidMotion::set_progress(double s) {
  progress_ = s;
  for (std::size_t p = 0; p < now_.size(); ++p) now_[p] = at(p, s);
  place();
}

// Places within the triangles are kept by number: they say nothing of another surface, as another version of
// the program may make it from the same scene.
void RigidMotion::serialize(Archive& archive) {
  const Archive::Group group(archive, "rigid body " + surface_->name);
  const bool kept = !archive.reading() || archive.knows("figures");
  const auto here = figures_of(*surface_);
  auto figures = here;
  if (kept) archive.numbers("figures", figures);
  if (!kept || !alike(figures, here))
    throw input_error("the checkpoint has other triangles of rigid body '" + surface_->name +
                          "' than this version of the program makes",
                      "Run without --restart, or go on with the version that wrote the checkpoint.");
  bulbus::serialize(archive, "start", start_);
  bulbus::serialize(archive, "now", now_);
  place();
}

void RigidMotion::freeze() {
  set_progress(1);
  start_ = now_;
  course_ = {};
  closing_ = 0;
}

void RigidMotion::place() {
  bool moved = false;
  for (std::size_t p = 0; p < now_.size(); ++p) {
    RigidSurface::Part& part = surface_->parts[p];
    part.closes = turned(now_[p].rotation, part.inwards);
    const Vec3<double> anchor = part.center + now_[p].shift;
    for (int i = 3 * part.first_point; i < 3 * (part.first_point + part.points); i += 3) {
      const Vec3<double> X{surface_->reference[i], surface_->reference[i + 1], surface_->reference[i + 2]};
      const Vec3<double> x = anchor + turned(now_[p].rotation, X - part.center);
      moved = moved || !std::equal(x.begin(), x.end(), surface_->places.begin() + i);
      std::copy(x.begin(), x.end(), surface_->places.begin() + i);
    }
    if (surface_->normals.empty()) continue;
    for (int t = part.first_triangle; t < part.first_triangle + part.triangles; ++t)
      for (int i = 0; i < 3; ++i)
        surface_->normals[t][i] = turned(now_[p].rotation, surface_->reference_normals[t][i]);
  }
  surface_->moves += moved;
}

}  // namespace bulbus::inline contact
