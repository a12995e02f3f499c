#include "contact/contact_term.hpp"

#include <algorithm>
#include <cmath>

#include "contact/meridians.hpp"

namespace bulbus {
namespace {

constexpr int most_changes = 4;
constexpr double softening = 0.1;
constexpr double rounding = 0.2;  // radius of sharp edges of a rigid body, in allowed depths: more than what the penalty lets in
constexpr double band = 0.02;  // half width of the smoothed onset, in allowed depths

Vec3<double> point(std::span<const double> x, int n) { return {x[3 * n], x[3 * n + 1], x[3 * n + 2]}; }

// How far the foot lies beyond an edge: −L_i / |∇L_i|
double overshoot(const Pair& p) {
  const auto& [t1, t2] = p.duals;
  const double l1 = norm({t1[0] + t2[0], t1[1] + t2[1], t1[2] + t2[2]});
  return std::max({-p.weights[0] / l1, -p.weights[1] / norm(t1), -p.weights[2] / norm(t2)});
}

FaceGap face_gap(const MasterSurface& master, const Pair& flat, int triangle) {
  if (master.normals.empty()) return {flat.gap, flat.normal};
  const CurvedGap curved = curved_gap(flat, master.corners(triangle), master.normals[triangle]);
  return {curved.gap, curved.gradient, curved.bend};
}

}  // namespace

ContactTerm::ContactTerm(const ContactSpec& spec, const ContactDefaults& defaults, const ContactSides& sides, const Comm& comm)
    : name_(spec.name),
      comm_(comm),
      master_(sides.master),
      slave_(sides.X, sides.owned, sides.slave, master_.nodes(), sides.symmetry),
      points_(slave_, sides.owned, master_.nodes(), spec.divisions),
      area0_(shape(sides.X).areas),
      penalty_(spec.penalty > 0 ? spec.penalty : defaults.penalty),
      tolerance_(spec.tolerance),
      edge_radius_(rounding * (spec.depth > 0 ? spec.depth : defaults.depth)),
      limits_{spec.depth > 0 ? spec.depth : defaults.depth, defaults.reach},
      search_(0, 0) {
  points_.bulge(sides.X, sides.slave, sides.symmetry);
  limits_.reach = std::max(limits_.reach, 2 * limits_.depth);
  search_ = GlobalSearch(limits_.reach, limits_.reach / 2, points_.of_a_face());
  if (master_.smooth()) {
    const MasterSurface m = master_.at({});
    rise_ = rise(m.facets, m.places, m.normals);
  }
  const std::size_t slots = static_cast<std::size_t>(points_.size()) * master_.pieces();
  current_.triangle.assign(slots, -1);
  current_.pressure.assign(slots, 0);
  begin_increment();
  committed_ = current_;
}

std::vector<double> ContactTerm::surfaces(const State& state) const {
  std::vector<double> key;
  const auto add = [&](int n) {
    for (int c = 0; c < 3; ++c) key.push_back(state.x[3 * n + c]);
  };
  for (const Quad& q : slave_.faces()) std::ranges::for_each(q, add);
  std::ranges::for_each(master_.nodes(), add);
  if (master_.rigid()) {
    const auto places = master_.places(state);
    key.insert(key.end(), places.begin(), places.end());
  }
  return key;
}

const ContactTerm::Found& ContactTerm::found(const State& state) const {
  auto key = surfaces(state);
  if (key.empty() || key != found_.key) {
    found_ = find(state, limits_, Search::sparing);
    found_.key = std::move(key);
  }
  return found_;
}

SlaveSurface::Shape ContactTerm::shape(std::span<const double> x) const {
  return points_.on_faces() ? points_.shape(x) : slave_.shape(x);
}

ContactTerm::Found ContactTerm::find(const State& state, const SearchLimits& near_by, Search how) const {
  Found f;
  f.shape = shape(state.x);
  const MasterSurface master = master_.at(state);
  const std::vector<double> points = outermost(state.x, f.shape);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::ranges::all_of(points, finite) || !std::ranges::all_of(master.places, finite)) return f;
  const bool history = how != Search::whole && look_back(points, master.places);
  SearchLimits limits = near_by;
  if (history) {
    f.motion = greatest_motion(points, start_.points) + greatest_motion(master.places, start_.places);
    if (f.motion > limits.reach) limits.reach = std::min(1.5 * f.motion, farthest_search * limits_.reach);
  }
  const Candidates& near = search_.update(points, master.facets.triangles, master.places, limits.reach);
  clearances_.move(points, master.places);
  const double margin = limits.depth + rise_;  // a point deeper than the depth may come back to the surface
  for (int i = 0; i < points_.size(); ++i) {
    if (how == Search::sparing && idle(i)) continue;
    const Vec3<double> x = point(points, i);
    double nearest = limits.reach;
    for (auto rest = near.of(i); !rest.empty();) {
      const int piece = master_.piece_of(rest.front()), slot = i * master_.pieces() + piece;
      const auto end = std::ranges::find_if(rest, [&](int t) { return master_.piece_of(t) != piece; });
      const auto candidates = rest.first(end - rest.begin());
      rest = rest.subspan(candidates.size());
      auto chosen = held(master, x, slot);
      const bool walks = !chosen;
      if (!chosen) {
        const int start = how != Search::whole ? committed_.triangle[slot] : -1;
        chosen = select(master, x, f.shape.normals[i], start, candidates, limits);
        if (history) follow(master, {point(start_.points, i), x}, f.shape.normals[i], start, candidates, *chosen);
      }
      nearest = std::min(nearest, walks ? chosen->distance : 0);
      if (chosen->triangle < 0) continue;
      f.touches.push_back(touch(master, x, i, slot, walks ? foot(master, x, chosen->triangle) : chosen->triangle));
      if (f.touches.back().pair.gap <= 0) nearest = 0;
    }
    clearances_.set(i, nearest - margin);
  }
  return f;
}

// The triangle whose curved surface a point is measured from; that of its normal line where it has come in too far to tell.
int ContactTerm::foot(const MasterSurface& master, const Vec3<double>& x, int triangle) const {
  if (!master_.smooth() || project(x, master.corners(triangle)).gap < -limits_.depth) return triangle;
  return foot_of(master, x, triangle);
}

// Is it known where the points were when the last increment ended? After a restart they are still there.
bool ContactTerm::look_back(std::span<const double> points, std::span<const double> places) const {
  if (start_.resumed) {
    start_.resumed = false;
    start_.points.assign(points.begin(), points.end());
    if (!master_.rigid()) start_.places.assign(places.begin(), places.end());
  }
  return !start_.points.empty();
}

// History decides: a point behind the surface is inside if it was in contact before or has come through the surface since, however deep it is
// now; on the far side of a thin layer it is not.
void ContactTerm::follow(const MasterSurface& master, const Way& way, const Vec3<double>& N, int start, std::span<const int> candidates,
                         Selection& chosen) const {
  const bool inside = chosen.triangle >= 0 && project(way.to, master.corners(chosen.triangle)).gap < 0;
  if (inside && start >= 0) return;
  const double on_surface = 1e-9 * limits_.reach;
  const bool touched = start >= 0 && project(way.from, corners_of(master.facets, start_.places, start)).gap <= on_surface;
  const int through = touched ? start : entered_through(master, start_.places, way, candidates, on_surface);
  if (inside && through < 0) chosen.triangle = -1;
  if (inside || through < 0) return;
  const int met = track(master, way.to, N, through), t = met >= 0 ? met : nearest_from(master, way.to, through);
  const Pair p = project(way.to, master.corners(t));
  const bool over = met >= 0 || std::ranges::min(p.weights) >= -1e-6;  // a way that leads in and out again ends beside the triangle
  if (over && p.gap < 0) chosen.triangle = t, chosen.distance = 0;
}

// Too far away to touch, and without a multiplier that could pull it back.
bool ContactTerm::idle(int point) const {
  const int first = point * master_.pieces();
  const auto p = std::span(current_.pressure).subspan(first, master_.pieces());
  return clearances_.far(point) && std::ranges::all_of(p, [](double v) { return v == 0; });
}

ContactTerm::Touch ContactTerm::touch(const MasterSurface& master, const Vec3<double>& x, int point, int slot, int triangle) const {
  Touch t{point, slot, triangle, project(x, master.corners(triangle))};
  if (!master_.rigid()) return t;
  FaceGap g = face_gap(master, t.pair, triangle);
  if (const auto across = master_.across_edges(triangle); !across.empty()) {
    std::vector<FaceGap> faces{g};
    for (int other : across)
      if (const FaceGap beside = face_gap(master, project(x, master.corners(other)), other); beside.gap > -edge_radius_) faces.push_back(beside);
    g = rounded_gap(faces, edge_radius_);
  }
  t.pair.gap = g.gap;
  t.pair.normal = g.normal;
  t.bend = g.bend;
  return t;
}

std::optional<Selection> ContactTerm::held(const MasterSurface& master, const Vec3<double>& x, int slot) const {
  if (current_.held[slot] < 0) return {};
  const Pair p = project(x, master.corners(current_.held[slot]));
  if (std::abs(p.gap) > limits_.reach || overshoot(p) > limits_.depth) return {};
  return Selection{current_.held[slot], std::abs(p.gap)};
}

double ContactTerm::gap(const Touch& t) const {
  return t.pair.gap + (current_.overlap.empty() ? 0 : fade_ * current_.overlap[t.slot]);
}

double ContactTerm::penalty() const { return soft_ ? softening * penalty_ : penalty_; }

bool ContactTerm::smoothed(int slot) const { return current_.changes[slot] > most_changes; }

ContactPressure ContactTerm::pressure(const Touch& t) const {
  return contact_pressure(current_.pressure[t.slot] - penalty() * gap(t), smoothed(t.slot) ? penalty() * band * limits_.depth : 0);
}

void ContactTerm::add_residual(const State& state, std::span<double> force, std::span<double> magnitude) const {
  for (const Touch& t : found(state).touches) {
    const SlavePoints::Point& point = points_[t.point];
    const double f = area0_[t.point] * pressure(t).value;
    if (f == 0 || !point.mine) continue;
    const auto add = [&](int node, const Vec3<double>& share) {
      for (int c = 0; c < 3; ++c) force[3 * node + c] -= f * share[c];
      if (!magnitude.empty()) magnitude[node] += f * norm(share);
    };
    const auto shares = points_.shares(t.point, state.x, t.pair.normal);
    for (int k = 0; k < point.carriers; ++k) add(point.nodes[k], shares[k]);
    if (!master_.rigid())
      for (int i = 0; i < 3; ++i) add(master_.node(t.triangle, i), -t.pair.weights[i] * t.pair.normal);
  }
}

// Counts openings, closings and returns to the triangle before; a point with too many keeps its triangle.
void ContactTerm::watch(const std::vector<int>& now) {
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (now[k] == last_[k] || !(now[k] < 0 || last_[k] < 0 || now[k] == before_[k])) continue;
    if (++current_.changes[k] <= most_changes || current_.held[k] >= 0) continue;
    current_.held[k] = now[k] >= 0 ? now[k] : last_[k];
    found_.key.clear();
  }
}

void ContactTerm::linearize(const State& state) {
  std::vector<int> now(last_.size(), -1);
  for (const Touch& t : found(state).touches)
    if (pressure(t).value > 0) now[t.slot] = t.triangle;
  if (linearized_) watch(now);
  tangent_.clear();
  for (const Touch& t : found(state).touches) {
    const ContactPressure p = pressure(t);
    if (p.value == 0 || !points_[t.point].mine) continue;
    // a hollow body's bend stiffens, and without it points that slide along diverge; where the body bulges it waits
    const bool quiet = linearized_ && (master_.rigid() ? last_[t.slot] >= 0 : last_[t.slot] == t.triangle);
    const bool bends = quiet || (master_.rigid() && trace(t.bend) < 0);
    add_tangent(state, t, area0_[t.point] * penalty() * p.slope, bends ? -area0_[t.point] * p.value : 0);
  }
  before_ = std::move(last_);
  last_ = std::move(now);
  linearized_ = true;
}

// a D Dᵀ + b Wᵀ H W: the point's row and column are shared out to its carriers.
void ContactTerm::add_tangent(const State& state, const Touch& t, double a, double b) {
  const SlavePoints::Point& point = points_[t.point];
  const auto shares = points_.shares(t.point, state.x, t.pair.normal);
  std::array<int, 7> nodes, row;
  std::array<double, 7> weights;
  std::array<double, 21> D;
  int n = 0;
  const auto add = [&](int node, int its_row, double weight, const Vec3<double>& d) {
    nodes[n] = node, row[n] = its_row, weights[n] = weight;
    std::ranges::copy(d, &D[3 * n++]);
  };
  for (int k = 0; k < point.carriers; ++k) add(point.nodes[k], 0, point.weights[k], shares[k]);
  if (!master_.rigid())
    for (int i = 0; i < 3; ++i) add(master_.node(t.triangle, i), 1 + i, 1, -t.pair.weights[i] * t.pair.normal);
  const auto K = tangent_.block({nodes.data(), static_cast<std::size_t>(n)});
  for (int i = 0; i < 3 * n; ++i)
    for (int j = 0; j < 3 * n; ++j) K[3 * n * i + j] += a * D[i] * D[j];
  if (b == 0) return;
  const auto bend = [&](std::span<const double> H, int width) {
    for (int i = 0; i < 3 * n; ++i)
      for (int j = 0; j < 3 * n; ++j)
        K[3 * n * i + j] += b * weights[i / 3] * weights[j / 3] * H[width * (3 * row[i / 3] + i % 3) + 3 * row[j / 3] + j % 3];
  };
  if (master_.rigid())
    bend({&t.bend.m[0][0], 9}, 3);
  else
    bend(tangent(t.pair, 0, 1), 12);
}

void ContactTerm::add_action(std::span<const double> dx, std::span<double> force) const { tangent_.add_action(dx, force); }

void ContactTerm::visit(const ContributionVisitor& visitor) const { tangent_.visit(visitor); }

double ContactTerm::potential(const State& state) const {
  double sum = 0;
  for (const Touch& t : found(state).touches)
    if (points_[t.point].mine) sum += area0_[t.point] / penalty() * pressure(t).integral;
  return sum;
}

}  // namespace bulbus
