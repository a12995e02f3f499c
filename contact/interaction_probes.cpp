#include "contact/interaction_probes.hpp"

#include <algorithm>

#include "contact/interaction_figures.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline contact {
namespace {

using Contact = Interactions::Contact;

// A figure of how one contact stands.
template <class Number>
auto of_contact(std::shared_ptr<const Interactions> interactions, Number number) {
  return [=](const Problem&, const ProbeSpec& spec) -> ProbeSet::Figure {
    return [interactions, number, &contact = interactions->contact(spec.contact, "contact")](Snapshot& s) {
      return number(standing(contact, s));
    };
  };
}

// A number of every slave node, or of those in the set, then mean, max or min.
template <class Number>
ProbeSet::Figure over_slaves(const Problem& problem, const Contact& contact, const std::string& set,
                             const std::string& statistic, Number number) {
  std::vector<bool> counts(problem.mesh().nodes(), set.empty());
  if (!set.empty())
    for (int n : problem.nodes_of(set)) counts[n] = true;
  if (!problem.comm().any(
          std::ranges::any_of(contact.term->slave().nodes(), [&](int n) { return counts[n]; })))
    throw scene_error("set",
                      "no node of '" + set + "' is a slave node of contact '" + contact.spec.name + "'",
                      "Name nodes of '" + contact.spec.slave + "' that its master does not share.");
  return [&contact, counts, statistic, number](Snapshot& s) {
    std::vector<double> numbers;
    for (const ContactNode& n : nodes_of(contact, s))
      if (counts[n.node]) numbers.push_back(number(n));
    return probes::statistic(s.problem.comm(), statistic, numbers);
  };
}

probes::Resultant on_body(const std::vector<const Contact*>& contacts, const std::string& of, Snapshot& s) {
  probes::Resultant sum;
  for (const Contact* contact : contacts) {
    const probes::Resultant r = on_master(*contact, s);
    for (int c = 0; c < 3; ++c) sum.force[c] += r.force[c], sum.moment[c] += r.moment[c];
    sum.radial += r.radial;
  }
  return probes::total(s.problem, sum, of);
}

}  // namespace

ProbeSet::Kinds interaction_probes(std::shared_ptr<const Interactions> interactions) {
  using Q = Quantity;
  using Figure = ProbeSet::Figure;
  ProbeSet::Kinds kinds;
  kinds["contact_area"] = {Q::area,
                           of_contact(interactions, [](const ContactStanding& c) { return c.area; })};
  kinds["contact_pressure"] = {Q::stress,
                               of_contact(interactions, [](const ContactStanding& c) { return c.pressure; })};
  kinds["penetration"] = {Q::length,
                          of_contact(interactions, [](const ContactStanding& c) { return c.penetration; })};
  kinds["contact_force"] = {Q::force, [=](const Problem&, const ProbeSpec& spec) -> Figure {
                              return [interactions, contact = &interactions->contact(spec.contact, "contact"),
                                      c = spec.component, of = spec.of](Snapshot& s) {
                                return on_body({contact}, of, s).component(c);
                              };
                            }};
  kinds["gap"] = {Q::length, [=](const Problem& problem, const ProbeSpec& spec) {
                    return over_slaves(problem, interactions->contact(spec.contact, "contact"), spec.set,
                                       spec.statistic,
                                       [interactions](const ContactNode& n) { return n.gap; });
                  }};
  kinds["closed_fraction"] = {
      Q::number, [=](const Problem& problem, const ProbeSpec& spec) {
        return over_slaves(
            problem, interactions->contact(spec.contact, "contact"), spec.set, "mean",
            [interactions, limit = spec.tolerance](const ContactNode& n) { return n.gap < limit ? 1. : 0.; });
      }};
  kinds["body_force"] = {Q::force, [=](const Problem&, const ProbeSpec& spec) -> Figure {
                           return [interactions, on = interactions->contacts_on(spec.body, "body"),
                                   c = spec.component,
                                   of = spec.of](Snapshot& s) { return on_body(on, of, s).component(c); };
                         }};
  kinds["body_moment"] = {Q::force,
                          [=](const Problem&, const ProbeSpec& spec) -> Figure {
                            return [interactions, on = interactions->contacts_on(spec.body, "body"),
                                    c = spec.component, of = spec.of](Snapshot& s) {
                              return probes::component_of(on_body(on, of, s).moment, c);
                            };
                          },
                          " mm"};
  kinds["suture_force"] = {Q::force, [=](const Problem&, const ProbeSpec& spec) -> Figure {
                             return [interactions, &suture = interactions->suture(spec.suture, "suture")](
                                        Snapshot&) { return suture.strings().front().force; };
                           }};
  kinds["suture_mises"] = {Q::stress, [=](const Problem& problem, const ProbeSpec& spec) {
                             interactions->suture(spec.suture, "suture");
                             return probes::mises_around(problem, spec, interactions->bites(spec.suture));
                           }};
  return kinds;
}

}  // namespace bulbus::inline contact
