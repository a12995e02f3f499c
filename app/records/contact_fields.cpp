#include "app/records/contact_fields.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/interaction_figures.hpp"

namespace bulbus::inline app {
namespace {

// Gap, pressure and status, NaN until a contact says something of the node.
class NodesInContact {
 public:
  NodesInContact(std::size_t nodes, const std::string& suffix) {
    for (const auto& [name, unit] :
         {std::pair{"gap", "mm"}, {"contact_pressure", "MPa"}, {"contact_status", ""}})
      fields_.push_back({name + suffix, 1, std::vector<double>(nodes, none), unit, true});
  }
  void add(const Interactions::Contact& contact, const std::vector<ContactNode>& nodes) {
    auto &gap = fields_[0].values, &pressure = fields_[1].values, &status = fields_[2].values;
    for (const ContactNode& n : nodes) {
      if (n.gap < contact.farthest) gap[n.node] = std::fmin(gap[n.node], n.gap);
      pressure[n.node] = n.pressure + (std::isnan(pressure[n.node]) ? 0 : pressure[n.node]);
      status[n.node] = std::fmax(status[n.node], n.active);
    }
  }
  void hand_over(const Halo& halo, std::vector<Field>& all) {
    for (Field& f : fields_) {
      halo.update_ghosts(f.values, 1);
      all.push_back(std::move(f));
    }
  }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<Field> fields_;
};

}  // namespace

std::vector<Field> contact_fields(const Interactions& interactions, Snapshot& s) {
  std::vector<Field> fields;
  if (interactions.contacts().empty()) return fields;
  const LocalMesh& mesh = s.problem.mesh();
  NodesInContact together(mesh.nodes(), "");
  std::vector<NodesInContact> each;
  for (const Interactions::Contact& contact : interactions.contacts()) {
    NodesInContact& alone = each.emplace_back(mesh.nodes(), safe_name("_" + contact.spec.name));
    for (const auto* nodes : {&nodes_of(contact, s), &master_nodes_of(contact, s)})
      together.add(contact, *nodes), alone.add(contact, *nodes);
  }
  together.hand_over(mesh.halo, fields);
  for (NodesInContact& alone : each)
    if (each.size() > 1) alone.hand_over(mesh.halo, fields);
  return fields;
}

}  // namespace bulbus::inline app
