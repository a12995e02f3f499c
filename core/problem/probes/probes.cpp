#include "core/problem/probes/probes.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline problem {
namespace {

const ProbeSet::Kinds& own_kinds() {
  using Q = Quantity;
  static const ProbeSet::Kinds table{{"displacement", {Q::length, probes::displacement}},
                                     {"position", {Q::length, probes::position}},
                                     {"distance", {Q::length, probes::distance}},
                                     {"buckle_height", {Q::length, probes::buckle_height}},
                                     {"reaction", {Q::force, probes::reaction}},
                                     {"moment", {Q::force, probes::moment, " mm"}},
                                     {"bar_force", {Q::force, probes::bar_force}},
                                     {"pressure", {Q::stress, probes::pressure}},
                                     {"volume", {Q::volume, probes::volume}},
                                     {"mises", {Q::stress, probes::mises}},
                                     {"volume_ratio", {Q::number, probes::volume_ratio}}};
  return table;
}

const ProbeSet::Kind& kind_of(const ProbeSpec& spec, const ProbeSet::Kinds& more, const std::string& key) {
  if (const auto found = more.find(spec.kind); found != more.end()) return found->second;
  if (const auto found = own_kinds().find(spec.kind); found != own_kinds().end()) return found->second;
  throw scene_error(key + ".kind", "nothing here can be asked for '" + spec.kind + "'",
                    "Take the probe out.");
}

int step_of(const Problem& problem, const std::string& name) {
  const auto& steps = problem.model().steps;
  return name.empty() ? -1
                      : static_cast<int>(std::ranges::find(steps, name, &StepSpec::name) - steps.begin());
}

// "mN mm" without " mm"
std::string without_suffix(const std::string& unit, const std::string& suffix) {
  if (!unit.ends_with(suffix)) throw std::invalid_argument("'" + unit + "' is not a force times" + suffix);
  return unit.substr(0, unit.size() - suffix.size());
}

double size_of_unit(const ProbeSpec& spec, const ProbeSet::Kind& kind, const std::string& key) {
  if (spec.unit.empty()) return 1;
  try {
    return parse_quantity("1 " + without_suffix(spec.unit, kind.suffix), kind.quantity);
  } catch (const std::invalid_argument& fault) {
    throw scene_error(key + ".unit", fault.what(),
                      "Give a unit of what a " + spec.kind + " measures, or leave it out.");
  }
}

}  // namespace

ProbeSet::ProbeSet(const Problem& problem, const Kinds& more) {
  const auto& specs = problem.model().probes;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const ProbeSpec& spec = specs[i];
    const std::string key = "probes." + std::to_string(i);
    const Kind& kind = kind_of(spec, more, key);
    const double factor = spec.scale / size_of_unit(spec, kind, key);
    std::string unit = spec.unit.empty() ? unit_of(kind.quantity) + kind.suffix : spec.unit;
    if (!spec.label.empty()) unit = spec.label;
    try {
      probes_.push_back(
          {spec.name, unit, factor, step_of(problem, spec.since), spec.peak, kind.make(problem, spec)});
    } catch (const InputError& fault) {
      throw InputError(fault.what(), key + "." + fault.key);
    }
  }
}

double ProbeSet::value(std::size_t i, Snapshot& snapshot) const {
  return probes_[i].figure(snapshot) * probes_[i].factor;
}

std::vector<double> ProbeSet::values(Snapshot& snapshot) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < size(); ++i) values.push_back(value(i, snapshot));
  return values;
}

std::vector<double> ProbeSet::values(const Problem& problem, const State& state) const {
  Snapshot snapshot(problem, state);
  return values(snapshot);
}

}  // namespace bulbus::inline problem
