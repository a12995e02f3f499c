#include "contact/contact_term.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus {
namespace {

constexpr int most_changes = 4;
constexpr double band = 0.02;  // half width of the smoothed onset, in allowed depths

Vec3<double> point(std::span<const double> x, int n) { return {x[3 * n], x[3 * n + 1], x[3 * n + 2]}; }

// How far the foot lies beyond an edge: −L_i / |∇L_i|
double overshoot(const Pair& p) {
  const auto& [t1, t2] = p.duals;
  const double l1 = norm({t1[0] + t2[0], t1[1] + t2[1], t1[2] + t2[2]});
  return std::max({-p.weights[0] / l1, -p.weights[1] / norm(t1), -p.weights[2] / norm(t2)});
}

}  // namespace

ContactTerm::ContactTerm(const ContactSpec& spec, const ContactDefaults& defaults, const ContactSides& sides, const Comm& comm)
    : comm_(comm),
      master_(sides.master),
      slave_(sides.X, sides.owned, sides.slave, master_.nodes(), sides.symmetry),
      area0_(slave_.shape(sides.X).areas),
      penalty_(spec.penalty > 0 ? spec.penalty : defaults.penalty),
      tolerance_(spec.tolerance),
      limits_{spec.depth > 0 ? spec.depth : defaults.depth, defaults.reach},
      search_(0, 0) {
  limits_.reach = std::max(limits_.reach, 2 * limits_.depth);
  search_ = GlobalSearch(limits_.reach, limits_.reach / 2);
  const std::size_t slots = slave_.nodes().size() * master_.pieces();
  current_.triangle.assign(slots, -1);
  current_.pressure.assign(slots, 0);
  committed_ = current_;
  begin_increment();
}

std::vector<double> ContactTerm::surfaces(const State& state) const {
  std::vector<double> key;
  const auto add = [&](int n) {
    for (int c = 0; c < 3; ++c) key.push_back(state.x[3 * n + c]);
  };
  for (const Quad& q : slave_.faces()) std::ranges::for_each(q, add);
  std::ranges::for_each(master_.nodes(), add);
  if (master_.rigid()) {
    const auto places = master_.at(state).places;
    key.insert(key.end(), places.begin(), places.end());
  }
  return key;
}

const ContactTerm::Found& ContactTerm::found(const State& state) const {
  auto key = surfaces(state);
  if (key.empty() || key != found_.key) {
    found_ = find(state, limits_, true);
    found_.key = std::move(key);
  }
  return found_;
}

ContactTerm::Found ContactTerm::find(const State& state, const SearchLimits& limits, bool remembered) const {
  Found f;
  f.shape = slave_.shape(state.x);
  const MasterSurface master = master_.at(state);
  std::vector<double> points;
  for (int n : slave_.nodes())
    for (int c = 0; c < 3; ++c) points.push_back(state.x[3 * n + c]);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::ranges::all_of(points, finite) || !std::ranges::all_of(master.places, finite)) return f;
  const Candidates& near = search_.update(points, master.facets.triangles, master.places);
  for (int i = 0; i < static_cast<int>(slave_.nodes().size()); ++i) {
    const Vec3<double> x = point(points, i);
    for (auto rest = near.of(i); !rest.empty();) {
      const int piece = master_.piece_of(rest.front()), slot = i * master_.pieces() + piece;
      const auto end = std::ranges::find_if(rest, [&](int t) { return master_.piece_of(t) != piece; });
      const auto candidates = rest.first(end - rest.begin());
      rest = rest.subspan(candidates.size());
      auto chosen = held(master, x, slot);
      if (!chosen) chosen = select(master, x, f.shape.normals[i], remembered ? committed_.triangle[slot] : -1, candidates, limits);
      if (chosen->triangle >= 0) f.touches.push_back(touch(master, x, i, slot, chosen->triangle));
    }
  }
  return f;
}

ContactTerm::Touch ContactTerm::touch(const MasterSurface& master, const Vec3<double>& x, int slave, int slot, int triangle) {
  Touch t{slave, slot, triangle, project(x, master.corners(triangle))};
  if (master.normals.empty()) return t;
  const SmoothNormal smooth = smooth_normal(t.pair, master.normals[triangle]);
  t.pair.normal = smooth.normal;
  t.bend = smooth.bend;
  return t;
}

std::optional<Selection> ContactTerm::held(const MasterSurface& master, const Vec3<double>& x, int slot) const {
  if (held_[slot] < 0) return {};
  const Pair p = project(x, master.corners(held_[slot]));
  if (std::abs(p.gap) > limits_.reach || overshoot(p) > limits_.depth) return {};
  return Selection{held_[slot], std::abs(p.gap)};
}

double ContactTerm::gap(const Touch& t) const {
  return t.pair.gap + (current_.overlap.empty() ? 0 : fade_ * current_.overlap[t.slot]);
}

bool ContactTerm::smoothed(int slot) const { return changes_[slot] > most_changes; }

ContactPressure ContactTerm::pressure(const Touch& t) const {
  return contact_pressure(current_.pressure[t.slot] - penalty_ * gap(t), smoothed(t.slot) ? penalty_ * band * limits_.depth : 0);
}

void ContactTerm::add_residual(const State& state, std::span<double> force, std::span<double> magnitude) const {
  for (const Touch& t : found(state).touches) {
    const double f = area0_[t.slave] * pressure(t).value;
    if (f == 0) continue;
    const auto add = [&](int node, double share) {
      for (int c = 0; c < 3; ++c) force[3 * node + c] -= f * share * t.pair.normal[c];
      if (!magnitude.empty()) magnitude[node] += std::abs(f * share);
    };
    add(slave_.nodes()[t.slave], 1);
    if (!master_.rigid())
      for (int i = 0; i < 3; ++i) add(master_.facets().triangles[t.triangle][i], -t.pair.weights[i]);
  }
}

// Counts openings, closings and, on flat triangles, returns to the one before; a node with too many keeps its triangle.
void ContactTerm::watch(const std::vector<int>& now) {
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (now[k] == last_[k] || !(now[k] < 0 || last_[k] < 0 || (now[k] == before_[k] && !master_.smooth()))) continue;
    if (++changes_[k] <= most_changes || held_[k] >= 0) continue;
    held_[k] = now[k] >= 0 ? now[k] : last_[k];
    found_.key.clear();
  }
}

void ContactTerm::linearize(const State& state) {
  std::vector<int> now(last_.size(), -1);
  for (const Touch& t : found(state).touches)
    if (pressure(t).value > 0) now[t.slot] = t.triangle;
  if (linearized_) watch(now);
  tangent_nodes_.clear();
  tangent_.clear();
  for (const Touch& t : found(state).touches) {
    const ContactPressure p = pressure(t);
    if (p.value == 0) continue;
    const double a = area0_[t.slave] * penalty_ * p.slope;
    tangent_nodes_.push_back(slave_.nodes()[t.slave]);
    if (master_.rigid()) {
      // where the body is hollow this stiffens, and without it nodes that slide along diverge; where it bulges it waits
      const bool quiet = linearized_ && last_[t.slot] >= 0;
      const auto K = rigid_tangent(t.pair, a, quiet || trace(t.bend) < 0 ? -area0_[t.slave] * p.value : 0, t.bend);
      tangent_.insert(tangent_.end(), K.begin(), K.end());
    } else {
      const auto& corners = master_.facets().triangles[t.triangle];
      tangent_nodes_.insert(tangent_nodes_.end(), corners.begin(), corners.end());
      const bool quiet = linearized_ && last_[t.slot] == t.triangle;
      const auto K = tangent(t.pair, a, quiet ? -area0_[t.slave] * p.value : 0);
      tangent_.insert(tangent_.end(), K.begin(), K.end());
    }
  }
  before_ = std::move(last_);
  last_ = std::move(now);
  linearized_ = true;
}

void ContactTerm::add_action(std::span<const double> dx, std::span<double> force) const {
  visit([&](std::span<const int> nodes, std::span<const double> K) {
    const std::size_t n = 3 * nodes.size();
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) force[3 * nodes[r / 3] + r % 3] += K[n * r + c] * dx[3 * nodes[c / 3] + c % 3];
  });
}

void ContactTerm::visit(const ContributionVisitor& visitor) const {
  const std::size_t k = master_.rigid() ? 1 : 4;
  for (std::size_t i = 0; i < tangent_nodes_.size() / k; ++i)
    visitor({&tangent_nodes_[k * i], k}, {&tangent_[9 * k * k * i], 9 * k * k});
}

double ContactTerm::potential(const State& state) const {
  double sum = 0;
  for (const Touch& t : found(state).touches) sum += area0_[t.slave] / penalty_ * pressure(t).integral;
  return sum;
}

}  // namespace bulbus
