#include <algorithm>

#include "contact/contact_term.hpp"
#include "contact/distances.hpp"

namespace bulbus {

ContactFigures ContactTerm::figures(const State& state) const {
  const Found& f = found(state);
  ContactFigures sum{.penetration = penetration(f), .on_master = std::vector<Wrench>(master_.pieces())};
  for (std::size_t k = 0; k < changes_.size(); ++k) sum.smoothed += smoothed(static_cast<int>(k));
  int counted = -1;  // a node that touches two pieces has one area
  for (const Touch& t : f.touches) {
    const double push = area0_[t.slave] * pressure(t).value;
    if (push == 0) continue;
    ++sum.pairs;
    if (counted != t.slave) sum.area += f.shape.areas[t.slave];
    counted = t.slave;
    const double* x = &state.x[3 * slave_.nodes()[t.slave]];
    Wrench& w = sum.on_master[t.slot % master_.pieces()];
    const Vec3<double> force{-push * t.pair.normal[0], -push * t.pair.normal[1], -push * t.pair.normal[2]};
    const Vec3<double> moment = cross({x[0], x[1], x[2]}, force);
    for (int c = 0; c < 3; ++c) w.force[c] += force[c], w.moment[c] += moment[c];
  }
  return sum;
}

std::vector<ContactNode> ContactTerm::nodes(const State& state, double farthest) const {
  const Found& f = found(state);
  std::vector<double> places;
  for (int n : slave_.nodes()) places.insert(places.end(), &state.x[3 * n], &state.x[3 * n] + 3);
  const auto distance = distances(places, master_.at(state), farthest > 0 ? farthest : limits_.reach);
  std::vector<ContactNode> nodes;
  for (std::size_t i = 0; i < distance.size(); ++i) nodes.push_back({slave_.nodes()[i], distance[i]});
  for (const Touch& t : f.touches) {
    ContactNode& n = nodes[t.slave];
    if (t.pair.gap < 0) n.gap = std::min(n.gap, t.pair.gap);
    const double push = area0_[t.slave] * pressure(t).value;
    n.pressure += push / f.shape.areas[t.slave];
    for (int c = 0; c < 3; ++c) n.force[c] += push * t.pair.normal[c];
    n.active |= push > 0;
  }
  return nodes;
}

}  // namespace bulbus
