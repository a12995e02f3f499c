#include "contact/law/contact_term.hpp"

#include <algorithm>
#include <cmath>

#include "contact/surfaces/meridians.hpp"

namespace bulbus::inline contact {
namespace {

// Tolerance of a linear solve with the default penalty: its scaled norm weighs gaps by the root of the
// penalty (docs/decisions/043).
constexpr double usual_solve = 1e-3;
// In shear moduli: an error of pressure that lets no contact open or close; pressures whose geometric
// stiffness is of no account beside the material's (docs/decisions/043 and 038).
constexpr double noticeable = 0.01, negligible = 0.01;
// A pressure that differs from the predicted one by no more than this factor has geometric terms
// (docs/decisions/038).
constexpr double settling = 2;
// Radius of sharp edges of a rigid body, in allowed depths: more than what the penalty lets in
// (docs/decisions/042).
constexpr double rounding = 0.2;
constexpr double rounding_of_cover = 1e-6;

}  // namespace

ContactTerm::ContactTerm(const ContactSpec& spec, const ContactDefaults& defaults, const ContactSides& sides,
                         const Comm& comm)
    : name_(spec.name),
      comm_(comm),
      master_(sides.master),
      slave_(sides.X, sides.owned, sides.slave, master_.nodes(), sides.symmetry),
      points_(slave_, sides.owned, master_.nodes(), spec.divisions),
      owned_(sides.owned),
      area0_(shape(sides.X).areas),
      penalty_(spec.penalty > 0 ? spec.penalty : defaults.penalty),
      stiffness_(defaults.penalty > 0 ? penalty_ / defaults.penalty : 1),
      tolerance_(spec.tolerance),
      edge_radius_(rounding * (spec.depth > 0 ? spec.depth : defaults.depth)),
      shear_(defaults.shear),
      modulus_(defaults.modulus),
      limits_{spec.depth > 0 ? spec.depth : defaults.depth, defaults.reach},
      search_(0, 0) {
  master_.mirror(mirrored(sides.X, master_.nodes(), sides.symmetry));
  points_.chordal_offset(sides.X, sides.slave, sides.symmetry);
  limits_.reach = std::max(limits_.reach, 2 * limits_.depth);
  search_ = GlobalSearch(limits_.reach, limits_.reach / 2, points_.of_a_face());
  if (master_.smooth()) {
    const MasterSurface m = master_.at({});
    rise_ = rise(m.facets, m.places, m.normals);
  }
  const std::size_t all = static_cast<std::size_t>(slots()) * master_.faces_at_a_point();
  current_.triangle.assign(all, -1);
  current_.pressure.assign(all, 0);
  begin_increment();
  committed_ = current_;
}

// φ: the part of the point that lies on the master.
double ContactTerm::cover(const Touch& t) const { return t.along ? t.along->cover : 1; }

// Reference area, of the part that lies on the master.
double ContactTerm::area(const Touch& t) const { return cover(t) * area0_[t.point]; }

// Past a rim of the master by more than rounding: such a point is pressed, the less the farther it is, but
// not inside of anything.
bool ContactTerm::beside(const Touch& t) const { return cover(t) < 1 - rounding_of_cover; }

double ContactTerm::gap(const Touch& t) const {
  return t.pair.gap + (current_.overlap.empty() ? 0 : fade_ * current_.overlap[t.slot]);
}

ContactPressure ContactTerm::pressure(const Touch& t) const {
  const double tau = current_.pressure[t.slot] - penalty_ * gap(t);
  return still_active(tau, predicted_[t.slot]) ? ContactPressure{tau, 1, tau * tau / 2}
                                               : contact_pressure(tau);
}

ContactTerm::PairGradient ContactTerm::gradient(const State& state, const Touch& t) const {
  const SlavePoints::Point& point = points_[t.point];
  PairGradient g;
  const auto add = [&](int node, const Vec3<double>& d) { g.nodes[g.size] = node, g.D[g.size++] = d; };
  const auto shares = points_.shares(t.point, state.x, t.pair.normal);
  for (int k = 0; k < point.carriers; ++k) add(point.nodes[k], shares[k]);
  if (!master_.rigid())
    for (int i = 0; i < 3; ++i) add(master_.node(t.triangle, i), -t.pair.weights[i] * t.pair.normal);
  return g;
}

void ContactTerm::predict(const TermTangent& tangent, std::span<const double> dx) {
  std::ranges::fill(predicted_, 0.);
  active_.clear();
  stepped_ = true;
  for (const PressureRate& r : static_cast<const Tangent&>(tangent).rates) {
    active_.push_back(r.slot);
    double gap = 0;
    for (int k = 0; k < r.gradient.size; ++k) gap += dot(r.gradient.D[k], at(dx, r.gradient.nodes[k]));
    if (releases_[r.slot] < most_releases) predicted_[r.slot] = r.pressure - r.stiffness * gap;
  }
}

void ContactTerm::add_residual(const State& state, std::span<double> force,
                               std::span<double> reference_force) const {
  for (const Touch& t : found(state).touches) {
    const double f = area(t) * pressure(t).value;
    if (f == 0 || !points_[t.point].mine) continue;
    const PairGradient g = gradient(state, t);
    for (int k = 0; k < g.size; ++k) {
      for (int c = 0; c < 3; ++c) force[3 * g.nodes[k] + c] -= f * g.D[k][c];
      if (!reference_force.empty()) reference_force[g.nodes[k]] += std::abs(f) * norm(g.D[k]);
    }
  }
}

std::shared_ptr<const TermTangent> ContactTerm::tangent(const std::shared_ptr<const State>& state) const {
  auto tangent = std::make_shared<Tangent>();
  const MasterSurface master = master_.at(*state);
  double highest = 0;
  for (const Touch& t : found(*state).touches) {
    const ContactPressure p = pressure(t);
    if (p.slope == 0) continue;
    if (area(t) > 0) highest = std::max(highest, p.value);
    tangent->rates.push_back({t.slot, p.value, penalty_ * p.slope, gradient(*state, t)});
    if (!points_[t.point].mine) continue;
    const double before = predicted_[t.slot];
    const bool settled = before > 0 && std::max(p.value, before) <= settling * std::min(p.value, before);
    if (settled && t.along && (shear_ == 0 || (p.value > negligible * shear_ && p.value < shear_))) {
      add_tangent_along(master, t, p, tangent->blocks);
      continue;
    }
    // a hollow body's bend stiffens, and without it points that slide along diverge; a bulging one's waits
    const bool bends = master_.rigid() && (before > 0 || trace(t.bend) < 0);
    add_tangent(t, tangent->rates.back().gradient, area(t) * penalty_ * p.slope,
                bends ? -area(t) * p.value : 0, tangent->blocks);
  }
  tangent->tolerance = needed_tolerance(comm_.max(highest));
  return tangent;
}

// The scaled norm of a linear system weighs gaps by the root of the penalty. An error of the highest pressure
// must not open or close other pairs.
double ContactTerm::needed_tolerance(double highest) const {
  double tolerance = usual_solve / std::sqrt(std::max(1., stiffness_));
  if (shear_ > 0 && highest > 0) tolerance = std::min(tolerance, noticeable * shear_ / highest);
  return tolerance;
}

// a D Dᵀ + b Wᵀ H W: the bend H of a rigid body at the point is shared out to its carriers, which are all
// nodes then.
void ContactTerm::add_tangent(const Touch& t, const PairGradient& g, double a, double b,
                              BlockTangent& blocks) const {
  const auto K = blocks.block({g.nodes.data(), static_cast<std::size_t>(g.size)});
  const auto& weights = points_[t.point].weights;
  const int n = 3 * g.size;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      double& entry = K[n * i + j];
      entry += a * g.D[i / 3][i % 3] * g.D[j / 3][j % 3];
      if (b != 0) entry += b * weights[i / 3] * weights[j / 3] * t.bend(i % 3, j % 3);
    }
}

void ContactTerm::add_tangent_along(const MasterSurface& master, const Touch& t, const ContactPressure& p,
                                    BlockTangent& blocks) const {
  const SlavePoints::Point& point = points_[t.point];
  std::vector<int> nodes;
  std::vector<ContactColumn> columns;
  const auto column = [&](int node) -> ContactColumn& {
    const auto at = std::ranges::find(nodes, node) - nodes.begin();
    if (at == std::ssize(nodes)) nodes.push_back(node), columns.emplace_back();
    return columns[at];
  };
  for (int k = 0; k < point.carriers; ++k) column(point.nodes[k]).carries += point.weights[k];
  for (int i = 0; i < 3; ++i) {
    const int corner = master.facets.triangles[t.triangle][i];
    column(master_.nodes()[corner]).corners[i] += 1;
    for (const NormalShare& s : master_.turning(corner, master.places))
      column(master_.nodes()[s.node]).turns[i] = s.turn;
  }
  bulbus::add_tangent(*t.along, master.normals[t.triangle], columns, {area(t), penalty_ * p.slope, p.value},
                      blocks.block(nodes));
}

double ContactTerm::potential(const State& state) const {
  double sum = 0;
  for (const Touch& t : found(state).touches)
    if (points_[t.point].mine) sum += area(t) / penalty_ * pressure(t).integral;
  return sum;
}

}  // namespace bulbus::inline contact
