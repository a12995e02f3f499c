#include "app/contact_summary.hpp"

#include <nlohmann/json.hpp>

namespace bulbus {
namespace {

using json = nlohmann::json;

void add(Wrench& sum, const Wrench& w) {
  for (int c = 0; c < 3; ++c) sum.force[c] += w.force[c], sum.moment[c] += w.moment[c];
}

}  // namespace

json contacts_summary(const Operation& operation, const std::vector<ContactStanding>& standings) {
  json all = json::object();
  for (std::size_t k = 0; k < operation.contacts().size(); ++k) {
    const auto& contact = operation.contacts()[k];
    const ContactStanding& now = standings[k];
    json& one = all[contact.spec.name] = {{"penalty", contact.penalty},
                                          {"thickness", contact.thickness},
                                          {"active_nodes", now.touching},
                                          {"area", now.area},
                                          {"largest_pressure", now.pressure},
                                          {"largest_penetration", now.penetration}};
    if (contact.spec.tolerance > 0)
      one["augmentation"] = {{"updates", now.augmentation.updates},
                             {"violation", now.augmentation.violation},
                             {"gave_up", now.augmentation.gave_up}};
  }
  return all;
}

json bodies_summary(const Problem& problem, const Operation& operation, const std::vector<ContactStanding>& standings) {
  json all = json::object();
  for (const auto& [name, body] : operation.bodies()) {
    std::vector<Wrench> parts(body->parts.size());
    Wrench sum;
    for (std::size_t k = 0; k < operation.contacts().size(); ++k)
      if (operation.contacts()[k].body == body)
        for (std::size_t p = 0; p < parts.size(); ++p) {
          add(parts[p], standings[k].on_master[p]);
          add(sum, standings[k].on_master[p]);
        }
    const auto whole = probes::with_images(problem, {sum.force, sum.moment});
    json& one = all[name] = {{"force", whole.force}, {"moment", whole.moment}, {"parts", json::array()}};
    for (const Wrench& w : parts) one["parts"].push_back({{"force", w.force}, {"moment", w.moment}});
  }
  return all;
}

}  // namespace bulbus
