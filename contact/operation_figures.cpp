#include "contact/operation_figures.hpp"

#include <algorithm>

namespace bulbus {

const std::vector<ContactNode>& nodes_of(const Operation::Contact& contact, Snapshot& s) {
  return s.derived(contact.term.get(), [&] { return contact.term->nodes(s.state, contact.farthest); });
}

probes::Resultant on_master(const Operation::Contact& contact, Snapshot& s) {
  probes::Resultant sum;
  for (const ContactNode& n : nodes_of(contact, s)) {
    const double* x = &s.state.x[3 * n.node];
    sum.add({x[0], x[1], x[2]}, {-n.force[0], -n.force[1], -n.force[2]});
  }
  return sum;
}

ContactStanding standing(const Operation::Contact& contact, Snapshot& s) {
  const Comm& comm = s.problem.comm();
  const ContactFigures own = contact.term->figures(s.state);
  ContactStanding all{.augmentation = contact.term->augmentation()};
  int touching = 0;
  double pressure = 0;
  for (const ContactNode& n : nodes_of(contact, s)) touching += n.active, pressure = std::max(pressure, n.pressure);
  all.touching = comm.sum(touching);
  all.area = s.problem.multiplicity() * comm.sum(own.area);
  all.penetration = comm.max(own.penetration);
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

}  // namespace bulbus
