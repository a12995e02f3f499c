#include "core/problem/probes.hpp"

#include <stdexcept>

#include "core/base/error.hpp"
#include "core/problem/probe_figures.hpp"

namespace bulbus {
namespace {

struct Kind {
  Quantity quantity;
  ProbeSet::Figure (*make)(const Problem&, const ProbeSpec&);
  std::string suffix = "";  // of the unit, where a quantity has no name of its own
};

const std::map<std::string, Kind>& kinds() {
  using Q = Quantity;
  static const std::map<std::string, Kind> table{{"displacement", {Q::length, probes::displacement}},
                                                 {"position", {Q::length, probes::position}},
                                                 {"distance", {Q::length, probes::distance}},
                                                 {"reaction", {Q::force, probes::reaction}},
                                                 {"moment", {Q::force, probes::moment, " mm"}},
                                                 {"bar_force", {Q::force, probes::bar_force}},
                                                 {"pressure", {Q::stress, probes::pressure}},
                                                 {"volume", {Q::volume, probes::volume}},
                                                 {"mises", {Q::stress, probes::mises}},
                                                 {"volume_ratio", {Q::number, probes::volume_ratio}}};
  return table;
}

// "mN mm" without " mm"
std::string without_suffix(const std::string& unit, const std::string& suffix) {
  if (!unit.ends_with(suffix)) throw std::invalid_argument("'" + unit + "' is not a force times" + suffix);
  return unit.substr(0, unit.size() - suffix.size());
}

double size_of_unit(const ProbeSpec& spec, const Kind& kind, const std::string& key) {
  if (spec.unit.empty()) return 1;
  try {
    return parse_quantity("1 " + without_suffix(spec.unit, kind.suffix), kind.quantity);
  } catch (const std::invalid_argument& fault) {
    throw scene_error(key + ".unit", fault.what(),
                      "Give a unit of what a " + spec.kind + " measures, or leave it out.");
  }
}

}  // namespace

ProbeSet::ProbeSet(const Problem& problem) {
  const auto& specs = problem.model().probes;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const ProbeSpec& spec = specs[i];
    const Kind& kind = kinds().at(spec.kind);
    const std::string key = "probes." + std::to_string(i);
    const double size = size_of_unit(spec, kind, key);
    const std::string unit = spec.unit.empty() ? unit_of(kind.quantity) + kind.suffix : spec.unit;
    try {
      probes_.push_back({spec.name, unit, size, kind.make(problem, spec)});
    } catch (const InputError& fault) {
      throw InputError(fault.what(), key + "." + fault.key);
    }
  }
}

std::vector<double> ProbeSet::values(Snapshot& snapshot) const {
  std::vector<double> values;
  for (const Probe& p : probes_) values.push_back(p.figure(snapshot) / p.size_of_unit);
  return values;
}

std::vector<double> ProbeSet::values(const Problem& problem, const State& state) const {
  Snapshot snapshot(problem, state);
  return values(snapshot);
}

}  // namespace bulbus
