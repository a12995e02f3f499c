#include "contact/elastic_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "core/base/error.hpp"

namespace bulbus::inline contact {
namespace {

void check_moves(const Model& model, const std::string& name) {
  bool touches = false;
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    for (std::size_t i = 0; i < model.steps[k].move.size(); ++i) {
      const MoveSpec& move = model.steps[k].move[i];
      if (move.body != name) continue;
      const std::string key = fmt::format("steps.{}.move.{}", k, i);
      if (move.close != 0 || move.rotate || norm(move.translate) > 0)
        throw scene_error(
            key, "the elastic band '" + name + "' finds its radius itself",
            "Give `shorten`, the way by which its circumference is shortened, and nothing else; "
            "or leave out the band's `stiffness`.");
      if (touches && move.from == "touch")
        throw scene_error(key + ".from", "the elastic band '" + name + "' touches already",
                          "Leave `from` out.");
      touches = true;
    }
  if (!touches)
    throw scene_error(
        "rigid_bodies." + name + ".band.stiffness", "has no effect: no step shortens the band",
        fmt::format("Give the step from which it is elastic `move: [{{body: {}, shorten: 0}}]`, or leave "
                    "`stiffness` out.",
                    name));
}

}  // namespace

ElasticBands::ElasticBands(Problem& problem, Interactions& interactions) : problem_(problem) {
  for (const auto& [name, spec] : problem.model().rigid_bodies) {
    if (!spec.band || spec.band->stiffness == 0) continue;
    const std::string key = "rigid_bodies." + name + ".band.stiffness";
    check_moves(problem.model(), name);
    bands_.emplace(name, Ring{ElasticBand(spec.band->stiffness, interactions.bodies().at(name)->shortening),
                              interactions.motion(name), *interactions.bodies().at(name), spec.band->radius,
                              band_arcs(problem, *interactions.bodies().at(name), name, key),
                              interactions.contacts_on(name, key)});
  }
}

// Of a ring of the radius that the arcs were drawn with, and of where they are now on the mean.
double ElasticBands::circumference(const Ring& ring) const {
  const auto& poses = ring.motion.poses();
  double closed = 0;
  for (std::size_t p = 0; p < poses.size(); ++p)
    closed += dot(poses[p].shift, ring.surface.parts[p].inwards) / static_cast<double>(poses.size());
  return 2 * std::numbers::pi * ring.radius - ring.surface.shortening * closed;
}

double ElasticBands::pressed(const Ring& ring, const State& state) const {
  double tension = 0;
  for (const Interactions::Contact* c : ring.contacts)
    tension += band_tension(ring.surface, ring.arcs, c->term->figures(state).on_master);
  return problem_.comm().sum(tension);
}

void ElasticBands::begin_step(int step, const State&) {
  for (const MoveSpec& move : problem_.model().steps.at(step).move)
    if (const auto found = bands_.find(move.body); found != bands_.end())
      found->second.band.shorten(circumference(found->second), move.shorten);
  set_progress(0);
}

bool ElasticBands::update_multipliers(const State& state) {
  bool again = false;
  for (auto& [name, ring] : bands_) {
    const bool settled = std::ranges::all_of(ring.contacts, [](const auto* c) { return c->term->settled(); });
    if (!settled || !ring.band.touches() || !ring.band.balance(pressed(ring, state))) continue;
    ring.motion.set_closing(ring.band.closing());
    for (const Interactions::Contact* c : ring.contacts) c->term->reopen();
    again = true;
  }
  return again;
}

std::string ElasticBands::refusal(const State&) const {
  for (const auto& [name, ring] : bands_)
    if (ring.band.gave_up())
      return fmt::format(
          "the elastic band '{}' has found no radius at which its tension of {:.3g} N balances "
          "what it presses on. Give the step more increments",
          name, ring.band.tension());
  return {};
}

void ElasticBands::extrapolate(double factor) {
  for (auto& [name, ring] : bands_) ring.band.extrapolate(factor);
}

void ElasticBands::set_progress(double s) {
  for (auto& [name, ring] : bands_)
    if (ring.band.touches()) {
      ring.band.set_progress(s);
      ring.motion.set_closing(ring.band.closing());
    }
}

void ElasticBands::freeze() {
  for (auto& [name, ring] : bands_) ring.band.freeze();
}

void ElasticBands::commit(const State&) {
  for (auto& [name, ring] : bands_) ring.band.commit();
}

void ElasticBands::serialize(Archive& archive) {
  for (auto& [name, ring] : bands_) {
    const Archive::Group group(archive, "elastic band " + name);
    ring.band.serialize(archive);
    ring.motion.set_closing(ring.band.closing());
  }
}

}  // namespace bulbus::inline contact
