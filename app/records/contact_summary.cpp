#include "app/records/contact_summary.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

void add(Wrench& sum, const Wrench& w) {
  for (int c = 0; c < 3; ++c) sum.force[c] += w.force[c], sum.moment[c] += w.moment[c];
}

std::string remedy_for(const Interactions::Contact& contact) {
  return fmt::format("Give a `penalty` larger than {:.3g} MPa/mm{}", contact.penalty,
                     contact.spec.two_way ? "" : ", or a `tolerance`");
}

}  // namespace

json contacts_summary(const Interactions& interactions, const std::vector<ContactStanding>& standings) {
  json all = json::object();
  for (std::size_t k = 0; k < standings.size(); ++k) {
    const auto& contact = interactions.contacts()[k];
    const ContactStanding& now = standings[k];
    json& one = all[contact.spec.name] = {
        {"penalty", contact.penalty},       {"thickness", contact.thickness},
        {"active_nodes", now.touching},     {"area", now.area},
        {"largest_pressure", now.pressure}, {"largest_penetration", now.penetration}};
    if (contact.spec.tolerance > 0)
      one["augmentation"] = {{"updates", now.augmentation.updates},
                             {"violation", now.augmentation.violation},
                             {"gave_up", now.augmentation.gave_up}};
  }
  return all;
}

std::vector<std::string> deep_contacts(const Interactions& interactions,
                                       const std::vector<ContactStanding>& standings) {
  constexpr double deep = 0.1;
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < standings.size(); ++k) {
    const auto& contact = interactions.contacts()[k];
    if (standings[k].penetration > deep * contact.thickness)
      sentences.push_back(
          fmt::format("the slave of contact '{}' penetrates by {:.3g} mm, {:.0f} % of the thinner layer: its "
                      "force depends on the penalty. {}",
                      contact.spec.name, standings[k].penetration,
                      100 * standings[k].penetration / contact.thickness, remedy_for(contact)));
  }
  return sentences;
}

std::vector<std::string> missed_tolerances(const Interactions& interactions,
                                           const std::vector<ContactStanding>& standings) {
  std::vector<std::string> sentences;
  for (std::size_t k = 0; k < standings.size(); ++k) {
    const auto& contact = interactions.contacts()[k];
    if (const auto& a = standings[k].augmentation; a.gave_up)
      sentences.push_back(
          fmt::format("contact '{}' misses its tolerance of {:.3g} mm after {} updates of the multipliers: "
                      "{:.3g} mm are left. "
                      "Give a `penalty` larger than {:.3g} MPa/mm",
                      contact.spec.name, contact.spec.tolerance, a.updates, a.violation, contact.penalty));
  }
  return sentences;
}

std::vector<std::string> lost_tangents(const Interactions& interactions, const Model& model) {
  std::vector<std::string> sentences;
  for (const auto& [name, term] : interactions.sutures())
    for (std::size_t point = 0; point < term->strings().size(); ++point)
      if (const SutureTerm::String& string = term->strings()[point]; string.lost && string.force != 0)
        sentences.push_back(fmt::format(
            "the string at point {} of suture '{}', ({:.4g}, {:.4g}, {:.4g}), has no tangent to the "
            "outline of '{}' any more: the point lies inside, or its plane misses the body, and the "
            "string pulls in its last direction. Sew it farther out, or move the body less",
            point, name, string.S[0], string.S[1], string.S[2], model.sutures.at(name).body));
  return sentences;
}

std::vector<std::string> soft_contacts(const Problem& problem, const Interactions& interactions,
                                       const std::vector<ContactStanding>& standings, const State& state) {
  constexpr double soft = 0.05, just_touching = 1e-9;  // of the energy, of the thinner layer
  std::vector<std::string> sentences;
  if (interactions.contacts().empty()) return sentences;
  const Comm& comm = problem.comm();
  const double tissue = comm.sum(problem.solid().energy(state.x));
  for (std::size_t k = 0; k < standings.size(); ++k) {
    const auto& contact = interactions.contacts()[k];
    if (contact.spec.tolerance > 0 || standings[k].penetration <= just_touching * contact.thickness) continue;
    double own = contact.term->potential(state);
    if (contact.exchanged) own += contact.exchanged->potential(state);
    own = comm.sum(own);
    if (const double part = own / (own + tissue); part > soft)
      sentences.push_back(fmt::format(
          "the penalty of contact '{}' holds {:.0f} % of the energy, {:.3g} of {:.3g} N mm: forces of "
          "bodies that are pressed together are too small by as much. {}",
          contact.spec.name, 100 * part, own, own + tissue, remedy_for(contact)));
  }
  return sentences;
}

json bodies_summary(const Problem& problem, const Interactions& interactions,
                    const std::vector<ContactStanding>& standings) {
  json all = json::object();
  for (const auto& [name, body] : interactions.bodies()) {
    std::vector<Wrench> parts(body->parts.size());
    Wrench sum;
    for (std::size_t k = 0; k < standings.size(); ++k)
      if (interactions.contacts()[k].body == body)
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

}  // namespace bulbus::inline app
