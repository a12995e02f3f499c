#include "contact/interaction_figures.hpp"

#include <algorithm>
#include <array>

namespace bulbus::inline contact {

namespace {

// Adds what the nodes of `term`'s slave feel as masters of `other`: forces, and the pressures that are these
// on the current areas.
void add_exchanged(const ContactTerm& term, const ContactTerm& other, const Snapshot& s,
                   std::vector<ContactNode>& nodes) {
  std::vector<double> minus_force(s.state.x.size());
  other.add_residual(s.state, minus_force, {});
  s.problem.mesh().halo.accumulate_ghosts(minus_force);
  const SlaveSurface::Shape shape = term.slave().shape(s.state.x);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3<double> force = -1. * at(minus_force, nodes[i].node);
    for (int c = 0; c < 3; ++c) nodes[i].force[c] += force[c];
    nodes[i].pressure -= dot(force, shape.normals[i]) / shape.areas[i];
    nodes[i].active |= norm(force) > 0;
  }
}

// Each side sees what its own points touch: the side whose points stand for less area sees it better.
double area_of_finer(const ContactFigures& own, const ContactFigures& other, const Comm& comm) {
  std::array<double, 4> sums{own.area, double(own.pairs), other.area, double(other.pairs)};
  comm.sum(sums);
  const auto [here, pairs_here, there, pairs_there] = sums;
  if (here == 0 || there == 0) return here + there;
  return here * pairs_there <= there * pairs_here ? here : there;
}

std::vector<ContactNode> nodes_of(const ContactTerm& term, const ContactTerm* other, double farthest,
                                  const Snapshot& s) {
  auto nodes = term.nodes(s.state, farthest);
  if (other) add_exchanged(term, *other, s, nodes);
  return nodes;
}

}  // namespace

const std::vector<ContactNode>& nodes_of(const Interactions::Contact& c, Snapshot& s) {
  return s.derived(c.term.get(), [&] { return nodes_of(*c.term, c.exchanged.get(), c.farthest, s); });
}

const std::vector<ContactNode>& master_nodes_of(const Interactions::Contact& c, Snapshot& s) {
  static const std::vector<ContactNode> none;
  if (!c.exchanged) return none;
  return s.derived(c.exchanged.get(), [&] { return nodes_of(*c.exchanged, c.term.get(), c.farthest, s); });
}

probes::Resultant on_master(const Interactions::Contact& contact, Snapshot& s) {
  probes::Resultant sum;
  for (const ContactNode& n : nodes_of(contact, s)) {
    const double* x = &s.state.x[3 * n.node];
    sum.add({x[0], x[1], x[2]}, {-n.force[0], -n.force[1], -n.force[2]});
  }
  return sum;
}

ContactStanding standing(const Interactions::Contact& contact, Snapshot& s) {
  const Comm& comm = s.problem.comm();
  const ContactFigures own = contact.term->figures(s.state);
  ContactStanding all{.augmentation = contact.term->augmentation()};
  int touching = 0;
  double pressure = 0;
  for (const ContactNode& n : nodes_of(contact, s))
    touching += n.active, pressure = std::max(pressure, n.pressure);
  all.touching = comm.sum(touching);
  all.area = comm.sum(own.area);
  all.penetration = comm.max(own.penetration);
  if (contact.exchanged) {
    const ContactFigures other = contact.exchanged->figures(s.state);
    all.area = area_of_finer(own, other, comm);
    all.penetration = std::max(all.penetration, comm.max(other.penetration));
  }
  all.area *= s.problem.multiplicity();
  all.pressure = comm.max(pressure);
  std::vector<double> sums;
  for (const Wrench& w : own.on_master) {
    sums.insert(sums.end(), w.force.begin(), w.force.end());
    sums.insert(sums.end(), w.moment.begin(), w.moment.end());
  }
  comm.sum(sums);
  for (std::size_t k = 0; k < sums.size(); k += 6)
    all.on_master.push_back({{sums[k], sums[k + 1], sums[k + 2]}, {sums[k + 3], sums[k + 4], sums[k + 5]}});
  return all;
}

}  // namespace bulbus::inline contact
