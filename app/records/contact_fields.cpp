#include "app/records/contact_fields.hpp"

#include <algorithm>

#include "contact/interaction_figures.hpp"

namespace bulbus {

std::vector<Field> contact_fields(const Interactions& interactions, Snapshot& s) {
  if (interactions.contacts().empty()) return {};
  const std::size_t nodes = s.problem.mesh().nodes();
  std::vector<Field> fields{{"gap", 1, std::vector<double>(nodes, interactions.contacts().front().farthest)},
                            {"contact_pressure", 1, std::vector<double>(nodes)},
                            {"contact_status", 1, std::vector<double>(nodes)}};
  auto &gap = fields[0].values, &pressure = fields[1].values, &status = fields[2].values;
  const auto add = [&](const std::vector<ContactNode>& of_a_side) {
    for (const ContactNode& n : of_a_side) {
      gap[n.node] = std::min(gap[n.node], n.gap);
      pressure[n.node] += n.pressure;
      if (n.active) status[n.node] = 1;
    }
  };
  for (const Interactions::Contact& contact : interactions.contacts())
    add(nodes_of(contact, s)), add(master_nodes_of(contact, s));
  for (Field& f : fields) s.problem.mesh().halo.update_ghosts(f.values, 1);
  return fields;
}

}  // namespace bulbus
