#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus::inline problem {

/// The figures that a model's probes ask for.
///
/// Positions and displacements are those of the model's own nodes. Forces, moments and volumes are of the
/// whole: with a symmetry plane the image's force cancels normal to the plane and adds along it; the moment
/// about the origin, which is no true vector, adds normal to the plane and cancels along it.
class ProbeSet {
 public:
  /// One figure of one state. Collective.
  using Figure = std::function<double(Snapshot&)>;

  struct Kind {
    Quantity quantity;
    std::function<Figure(const Problem&, const ProbeSpec&)>
        make;                 ///< collective; may throw InputError with a key
    std::string suffix = "";  ///< of the unit, where a quantity has no name of its own
  };
  using Kinds = std::map<std::string, Kind>;

  /// `more`: kinds from a floor above. Throws InputError (with the key) for a unit that does not fit, a
  /// region that is rigid, or a kind that nobody knows. Collective.
  explicit ProbeSet(const Problem& problem, const Kinds& more = {});

  /// One value per probe, in its unit and scaled, the same on every rank; `since` is left to ProbeRecord.
  /// Collective.
  std::vector<double> values(Snapshot& snapshot) const;
  std::vector<double> values(const Problem& problem, const State& state) const;
  double value(std::size_t i, Snapshot& snapshot) const;

  std::size_t size() const { return probes_.size(); }
  const std::string& name(std::size_t i) const { return probes_[i].name; }
  /// The unit of the values: "mm", "mmHg", ...; empty for a plain number.
  const std::string& unit(std::size_t i) const { return probes_[i].unit; }
  /// The step since whose end the probe counts, -1: from the start.
  int since(std::size_t i) const { return probes_[i].since; }
  /// Does the record keep the largest value so far?
  bool peak(std::size_t i) const { return probes_[i].peak; }

 private:
  struct Probe {
    std::string name, unit;
    double factor;  ///< from mm, N, MPa to the record
    int since;
    bool peak;
    Figure figure;
  };
  std::vector<Probe> probes_;
};

}  // namespace bulbus::inline problem
