#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/problem/probe_snapshot.hpp"

namespace bulbus {

/// The figures that a model's probes ask for.
///
/// Places and displacements are those of the model's own nodes. Forces, moments and volumes are of the whole:
/// with a symmetry plane the image's force cancels normal to the plane and adds along it; the moment about
/// the origin, which is no true vector, adds normal to the plane and cancels along it.
class ProbeSet {
 public:
  /// One figure of one state. Collective.
  using Figure = std::function<double(Snapshot&)>;

  /// Throws InputError (with the key) for a unit that does not fit or a region that is rigid. Collective.
  explicit ProbeSet(const Problem& problem);

  /// One value per probe, in its unit, the same on every rank. Collective.
  std::vector<double> values(Snapshot& snapshot) const;
  std::vector<double> values(const Problem& problem, const State& state) const;

  std::size_t size() const { return probes_.size(); }
  const std::string& name(std::size_t i) const { return probes_[i].name; }
  /// The unit of the values: "mm", "mmHg", ...; empty for a plain number.
  const std::string& unit(std::size_t i) const { return probes_[i].unit; }

 private:
  struct Probe {
    std::string name, unit;
    double size_of_unit;  ///< in mm, N, MPa
    Figure figure;
  };
  std::vector<Probe> probes_;
};

}  // namespace bulbus
