#include "contact/interaction_probes.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "contact/band_tension.hpp"
#include "contact/interaction_figures.hpp"
#include "core/base/error.hpp"
#include "core/mesh/distributed/bounds.hpp"
#include "core/problem/closed_surface.hpp"

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
template <class Numbers>
ProbeSet::Figure over_slaves(const Problem& problem, const Contact& contact, const std::string& set,
                             const std::string& statistic, Numbers numbers) {
  std::vector<bool> counts(problem.mesh().nodes(), set.empty());
  if (!set.empty())
    for (int n : problem.nodes_of(set)) counts[n] = true;
  if (!problem.comm().any(
          std::ranges::any_of(contact.term->slave().nodes(), [&](int n) { return counts[n]; })))
    throw scene_error("set",
                      "no node of '" + set + "' is a slave node of contact '" + contact.spec.name + "'",
                      "Name nodes of '" + contact.spec.slave + "' that its master does not share.");
  return [&contact, counts, statistic, numbers](Snapshot& s) {
    std::vector<ContactNode> nodes;
    for (const ContactNode& n : nodes_of(contact, s))
      if (counts[n.node]) nodes.push_back(n);
    return probes::statistic(s.problem.comm(), statistic, numbers(s.state, nodes));
  };
}

// Also of nodes that are too far away for the fields.
std::vector<double> gaps(const Contact& contact, const State& state, std::vector<ContactNode> nodes) {
  contact.term->measure_far(state, nodes);
  std::vector<double> gaps;
  for (const ContactNode& n : nodes) gaps.push_back(n.gap);
  return gaps;
}

std::vector<double> closed(const std::vector<ContactNode>& nodes, double tolerance) {
  std::vector<double> closed;
  for (const ContactNode& n : nodes) closed.push_back(n.gap < tolerance);
  return closed;
}

// Of faces as polygons, on this rank, mm².
double slave_area(const Contact& contact, const Snapshot& s) {
  double sum = 0;
  for (const Quad& q : contact.term->slave().faces()) {
    if (q[0] >= s.problem.mesh().owned) continue;
    std::array<Vec3<double>, 4> x;
    for (int c = 0; c < 4; ++c) x[c] = at(s.state.x, q[c]);
    sum += norm(cross(minus(x[2], x[0]), minus(x[3], x[1]))) / 2;
  }
  return sum;
}

// Areas of points and of faces as polygons differ by some thousandths.
ProbeSet::Figure contact_fraction(const Contact& contact) {
  return [&contact](Snapshot& s) {
    return std::min(1., standing(contact, s).area /
                            (s.problem.multiplicity() * s.problem.comm().sum(slave_area(contact, s))));
  };
}

// Σ |f| over the area in contact.
ProbeSet::Figure mean_contact_pressure(const Contact& contact) {
  return [&contact](Snapshot& s) {
    double force = 0;
    for (const ContactNode& n : nodes_of(contact, s)) force += norm(n.force);
    force = s.problem.multiplicity() * s.problem.comm().sum(force);
    const double area = standing(contact, s).area;
    return area > 0 ? force / area : 0;
  };
}

// Undeformed length of the slave's edge at a set that belongs to each of its nodes: half of either side's.
std::map<int, double> edge_lengths(const Problem& problem, const Contact& contact, const std::string& set) {
  const std::vector<int>& nodes = problem.nodes_of(set);
  const std::set<int> named(nodes.begin(), nodes.end());
  std::map<std::array<int, 2>, int> faces_of_edge;
  for (const Quad& q : contact.term->slave().faces())
    for (int c = 0; c < 4; ++c) {
      const auto [a, b] = std::minmax(q[c], q[(c + 1) % 4]);
      if (named.contains(a) && named.contains(b)) ++faces_of_edge[{a, b}];
    }
  const std::span<const double> X = problem.mesh().X;
  const Bounds model = bounds_of(problem.comm(), X);
  const double on_plane = 1e-9 * norm(model.sides());
  std::map<int, double> lengths;
  for (const auto& [edge, faces] : faces_of_edge) {
    const Vec3<double> a = at(X, edge[0]), b = at(X, edge[1]);
    const bool in_plane = std::ranges::any_of(problem.model().symmetry, [&](const std::string& plane) {
      return std::max(std::abs(a[axis_of(plane)]), std::abs(b[axis_of(plane)])) <= on_plane;
    });
    if (faces != 1 || in_plane) continue;
    for (int n : edge) lengths[n] += norm(minus(a, b)) / 2;
  }
  return lengths;
}

ProbeSet::Figure sealed_fraction(const Problem& problem, const Contact& contact, const std::string& set) {
  auto lengths = edge_lengths(problem, contact, set);
  double all = 0;
  for (int n : contact.term->slave().nodes())
    if (const auto found = lengths.find(n); found != lengths.end()) all += found->second;
  all = problem.comm().sum(all);
  if (all == 0)
    throw scene_error("set", "'" + set + "' has no edge of the slave of contact '" + contact.spec.name + "'",
                      "Name nodes along an edge of '" + contact.spec.slave + "', such as a tear's rim.");
  return [&contact, lengths = std::move(lengths), all](Snapshot& s) {
    double sealed = 0;
    for (const ContactNode& n : nodes_of(contact, s))
      if (const auto found = lengths.find(n.node); n.active && found != lengths.end())
        sealed += found->second;
    return s.problem.comm().sum(sealed) / all;
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
                    const Contact& contact = interactions->contact(spec.contact, "contact");
                    return over_slaves(problem, contact, spec.set, spec.statistic,
                                       [interactions, &contact](const State& state, const auto& nodes) {
                                         return gaps(contact, state, nodes);
                                       });
                  }};
  kinds["closed_fraction"] = {Q::number, [=](const Problem& problem, const ProbeSpec& spec) {
                                return over_slaves(
                                    problem, interactions->contact(spec.contact, "contact"), spec.set, "mean",
                                    [interactions, limit = spec.tolerance](const State&, const auto& nodes) {
                                      return closed(nodes, limit);
                                    });
                              }};
  const auto of_spec = [interactions](auto figure) {
    return [=](const Problem&, const ProbeSpec& spec) {
      return [interactions, f = figure(interactions->contact(spec.contact, "contact"))](Snapshot& s) {
        return f(s);
      };
    };
  };
  kinds["contact_fraction"] = {Q::number, of_spec(contact_fraction)};
  kinds["mean_contact_pressure"] = {Q::stress, of_spec(mean_contact_pressure)};
  kinds["sealed_fraction"] = {
      Q::number, [=](const Problem& problem, const ProbeSpec& spec) -> Figure {
        const Contact& contact = interactions->contact(spec.contact, "contact");
        return [interactions, f = sealed_fraction(problem, contact, spec.set)](Snapshot& s) { return f(s); };
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
  kinds["band_tension"] = {Q::force, [=](const Problem& problem, const ProbeSpec& spec) -> Figure {
                             const auto on = interactions->contacts_on(spec.body, "body");
                             const BandArcs arcs =
                                 band_arcs(problem, *interactions->bodies().at(spec.body), spec.body, "body");
                             return [interactions, on, arcs](Snapshot& s) {
                               double tension = 0;
                               for (const Contact* c : on)
                                 tension += band_tension(*c->body, arcs, standing(*c, s).on_master);
                               return tension;
                             };
                           }};
  kinds["suture_force"] = {Q::force, [=](const Problem&, const ProbeSpec& spec) -> Figure {
                             return [interactions, &suture = interactions->suture(spec.suture, "suture")](
                                        Snapshot&) { return suture.strings().front().force; };
                           }};
  kinds["suture_mises"] = {
      Q::stress, [=](const Problem& problem, const ProbeSpec& spec) {
        interactions->suture(spec.suture, "suture");
        return spec.within > 0
                   ? probes::mean_mises_near(problem, spec, interactions->suture_places(spec.suture))
                   : probes::mises_around(problem, spec, interactions->bites(spec.suture));
      }};
  return kinds;
}

}  // namespace bulbus::inline contact
