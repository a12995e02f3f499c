#include <algorithm>

#include "contact/contact_term.hpp"
#include "contact/distances.hpp"
#include "contact/meridians.hpp"

namespace bulbus {

ContactFigures ContactTerm::figures(const State& state) const {
  const Found& f = found(state);
  ContactFigures sum{.penetration = penetration(f), .on_master = std::vector<Wrench>(master_.pieces())};
  for (std::size_t k = 0; k < current_.changes.size(); ++k) sum.smoothed += smoothed(static_cast<int>(k));
  const std::vector<double> places = outermost(state.x, f.shape);
  int counted = -1;  // a point that touches two pieces has one area
  for (const Touch& t : f.touches) {
    const double push = area0_[t.point] * pressure(t).value;
    if (push == 0 || !points_[t.point].mine) continue;
    ++sum.pairs;
    if (counted != t.point) sum.area += f.shape.areas[t.point];
    counted = t.point;
    Wrench& w = sum.on_master[t.slot % master_.pieces()];
    const Vec3<double> force = -push * t.pair.normal;
    const Vec3<double> moment = cross({places[3 * t.point], places[3 * t.point + 1], places[3 * t.point + 2]}, force);
    for (int c = 0; c < 3; ++c) w.force[c] += force[c], w.moment[c] += moment[c];
  }
  return sum;
}

// A node's force is the sum of its points'; its gap the smallest of those that lie next to it.
std::vector<ContactNode> ContactTerm::nodes(const State& state, double farthest) const {
  const Found& f = found(state);
  std::vector<double> places;
  for (int n : slave_.nodes()) places.insert(places.end(), &state.x[3 * n], &state.x[3 * n] + 3);
  const auto distance = distances(places, master_.at(state), farthest > 0 ? farthest : limits_.reach);
  std::vector<ContactNode> nodes;
  for (std::size_t i = 0; i < distance.size(); ++i) nodes.push_back({slave_.nodes()[i], distance[i]});
  const std::vector<double> areas = points_.on_faces() ? slave_.shape(state.x).areas : f.shape.areas;
  for (const Touch& t : f.touches) {
    const SlavePoints::Point& point = points_[t.point];
    const double push = area0_[t.point] * pressure(t).value;
    const auto shares = points_.shares(t.point, state.x, t.pair.normal);
    for (int k = 0; k < point.carriers; ++k) {
      const auto at = std::ranges::lower_bound(slave_.nodes(), point.nodes[k]);
      if (at == slave_.nodes().end() || *at != point.nodes[k]) continue;
      const std::size_t i = at - slave_.nodes().begin();
      ContactNode& n = nodes[i];
      if (gap(t) < 0 && 2 * point.weights[k] > std::ranges::max(point.weights)) n.gap = std::min(n.gap, gap(t));
      n.pressure += point.weights[k] * push / areas[i];
      for (int c = 0; c < 3; ++c) n.force[c] += push * shares[k][c];
      n.active |= push > 0;
    }
  }
  return nodes;
}

}  // namespace bulbus
