#include <algorithm>
#include <cmath>
#include <map>

#include "contact/law/contact_area.hpp"
#include "contact/law/contact_term.hpp"
#include "contact/search/distances.hpp"
#include "contact/surfaces/meridians.hpp"

namespace bulbus::inline contact {
namespace {

// N·n: inside a face nothing presses from there; at nodes on the rim of a slave surface a wall beside it may
// stand at right angles: 87 and 60 degrees.
constexpr double same_side = 0.05, same_side_of_node = 0.5;

}  // namespace

Overlap of_all_ranks(const Overlap& mine, const Comm& comm) {
  const std::array<double, 4> deepest{mine.depth, mine.place[0], mine.place[1], mine.place[2]};
  const auto all = comm.gather(std::span<const double>(deepest));
  Overlap o{.points = comm.sum(mine.points)};
  for (std::size_t r = 0; r < all.size(); r += 4)
    if (all[r] > o.depth) o.depth = all[r], o.place = {all[r + 1], all[r + 2], all[r + 3]};
  return o;
}

ContactFigures ContactTerm::figures(const State& state) const {
  const Found& f = found(state);
  ContactFigures sum{.penetration = penetration(f), .on_master = std::vector<Wrench>(master_.pieces())};
  const std::vector<double> places = outermost(state.x, f.shape);
  for (const Touch& t : f.touches) {
    const double push = area(t) * pressure(t).value;
    if (push == 0 || !points_[t.point].mine) continue;
    ++sum.pairs;
    Wrench& w = sum.on_master[t.slot % master_.pieces()];
    const Vec3<double> force = -push * t.pair.normal;
    const Vec3<double> moment = cross(at(places, t.point), force);
    for (int c = 0; c < 3; ++c) w.force[c] += force[c], w.moment[c] += moment[c];
  }
  if (points_.on_faces()) {
    sum.area = area_of_points(f);
  } else {
    sum.area = area_of_faces(state, f);
    const double missing = least_area(f) - comm_.sum(sum.area);
    if (comm_.rank() == 0) sum.area += std::max(0., missing);
  }
  return sum;
}

// Contact that is narrower than an edge has next to no area on the faces beside it: no less than what would
// carry the force with the largest nodal pressure. Of all ranks.
double ContactTerm::least_area(const Found& f) const {
  double force = 0, most = 0, of_point = 0;
  int last = -1;
  for (const Touch& t : f.touches) {
    if (!points_[t.point].mine) continue;
    const double push = area(t) * pressure(t).value;
    if (push == 0) continue;
    of_point = (t.point == last ? of_point : 0) + push / cover(t), last = t.point;
    force += push, most = std::max(most, of_point / f.shape.areas[t.point]);
  }
  force = comm_.sum(force), most = comm_.max(most);
  return most > 0 ? force / most : 0;
}

Overlap ContactTerm::overlap_of(const Found& f, const State& state,
                                const std::function<bool(const Touch&)>& counts) const {
  Overlap o;
  const std::vector<double> places = points_.places(state.x);
  for (const Touch& t : f.touches)
    if (points_[t.point].mine && !beside(t) && counts(t)) o.add(-gap(t), at(places, t.point));
  return o;
}

Overlap ContactTerm::inside(const State& state,
                            const std::function<double(const SlavePoints::Point&, double)>& allowed) const {
  const Found& f = found(state);
  return overlap_of(
      f, state, [&](const Touch& t) { return -gap(t) > allowed(points_[t.point], f.shape.areas[t.point]); });
}

Overlap ContactTerm::behind(const State& state) const {
  const Found& f = found(state);
  const double most = points_.on_faces() ? same_side : same_side_of_node;
  return overlap_of(f, state, [&](const Touch& t) {
    return pressure(t).value > 0 && dot(t.pair.normal, f.shape.normals[t.point]) > most;
  });
}

std::vector<int> ContactTerm::active_nodes(const State& state) const {
  std::vector<int> nodes;
  for (const Touch& t : found(state).touches)
    if (area(t) * pressure(t).value > 0) nodes.push_back(points_[t.point].nodes[0]);
  return nodes;
}

double ContactTerm::area_of_points(const Found& f) const {
  std::vector<PointInContact> points;
  int last = -1;  // a point that touches two pieces has one area
  for (const Touch& t : f.touches) {
    const double p = area(t) > 0 ? pressure(t).value : 0;
    if (!points_[t.point].mine || p == 0) continue;
    if (t.point == last)
      points.back().pressure = std::max(points.back().pressure, p);
    else
      points.push_back({p, cover(t) * f.shape.areas[t.point]});
    last = t.point;
  }
  return area_in_contact(points, comm_);
}

// Each face is of the rank that owns its first corner; the others tell that rank of corners of their own.
double ContactTerm::area_of_faces(const State& state, const Found& f) const {
  const NodeInContact far{0, limits_.reach, 0};
  std::map<int, NodeInContact> of_node;
  for (const Touch& t : f.touches) {
    NodeInContact& n = of_node.try_emplace(points_[t.point].nodes[0], far).first->second;
    const double p = area(t) > 0 ? pressure(t).value : 0;
    n = {std::max(n.pressure, p), std::min(n.gap, gap(t)), std::max(n.cover, cover(t))};
  }
  const auto faces = slave_.faces();
  std::vector<double> told;  // number of face and corner, pressure, gap, cover
  for (std::size_t k = 0; k < faces.size(); ++k)
    for (int c = 0; c < 4 && faces[k][0] >= owned_; ++c)
      if (const auto n = of_node.find(faces[k][c]); faces[k][c] < owned_ && n != of_node.end())
        told.insert(told.end(),
                    {4. * slave_.numbers()[k] + c, n->second.pressure, n->second.gap, n->second.cover});
  told = comm_.gather(told);
  std::map<long long, NodeInContact> of_corner;
  for (std::size_t k = 0; k < told.size(); k += 4)
    of_corner[static_cast<long long>(told[k])] = {told[k + 1], told[k + 2], told[k + 3]};
  const auto corner = [&](std::size_t face, int c) {
    if (std::ranges::binary_search(master_.nodes(), faces[face][c])) return NodeInContact{0, 0};
    if (const auto n = of_node.find(faces[face][c]); n != of_node.end()) return n->second;
    const auto n = of_corner.find(4LL * slave_.numbers()[face] + c);
    return n == of_corner.end() ? far : n->second;
  };
  double sum = 0;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (faces[k][0] >= owned_) continue;
    std::array<NodeInContact, 4> corners;
    std::array<Vec3<double>, 4> x;
    std::array<double, 4> lengths;
    for (int c = 0; c < 4; ++c) corners[c] = corner(k, c), x[c] = at(state.x, faces[k][c]);
    for (int c = 0; c < 4; ++c) lengths[c] = norm(minus(x[(c + 1) % 4], x[c]));
    sum +=
        part_in_contact(corners, lengths, modulus_) * norm(cross(minus(x[2], x[0]), minus(x[3], x[1]))) / 2;
  }
  return sum;
}

// A node's force is the sum of its points'; its gap the smallest of those that lie next to it.
std::vector<ContactNode> ContactTerm::nodes(const State& state, double farthest) const {
  const Found& f = found(state);
  std::vector<double> places;
  for (int n : slave_.nodes()) places.insert(places.end(), &state.x[3 * n], &state.x[3 * n] + 3);
  const auto gaps = distances(places, master_.at(state), farthest > 0 ? farthest : limits_.reach);
  std::vector<ContactNode> nodes;
  for (std::size_t i = 0; i < gaps.size(); ++i) nodes.push_back({slave_.nodes()[i], gaps[i]});
  const std::vector<double> areas = points_.on_faces() ? slave_.shape(state.x).areas : f.shape.areas;
  for (const Touch& t : f.touches) {
    const SlavePoints::Point& point = points_[t.point];
    const double push = area(t) * pressure(t).value;
    const auto shares = points_.shares(t.point, state.x, t.pair.normal);
    for (int k = 0; k < point.carriers; ++k) {
      const auto at = std::ranges::lower_bound(slave_.nodes(), point.nodes[k]);
      if (at == slave_.nodes().end() || *at != point.nodes[k]) continue;
      const std::size_t i = at - slave_.nodes().begin();
      ContactNode& n = nodes[i];
      if (gap(t) < 0 && !beside(t) && 2 * point.weights[k] > std::ranges::max(point.weights))
        n.gap = std::min(n.gap, gap(t));
      n.pressure += point.weights[k] * push / areas[i];
      for (int c = 0; c < 3; ++c) n.force[c] += push * shares[k][c];
      n.active |= push > 0;
    }
  }
  return nodes;
}

void ContactTerm::measure_far(const State& state, std::span<ContactNode> nodes) const {
  const auto far = [](const ContactNode& n) { return std::isinf(n.gap); };
  if (std::ranges::none_of(nodes, far)) return;
  const MasterSurface master = master_.at(state);
  for (ContactNode& n : nodes)
    if (far(n)) n.gap = distance(at(state.x, n.node), master);
}

}  // namespace bulbus::inline contact
