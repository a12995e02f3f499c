#pragma once
#include <map>
#include <optional>

#include "core/problem/probes/probes.hpp"

namespace bulbus::inline problem {

/// One per probe; none where the step that it counts from has not ended.
using ProbeValues = std::vector<std::optional<double>>;

/// The values of a run's probes, some of which count from the end of a step: it keeps the positions and
/// figures of those ends.
class ProbeRecord {
 public:
  explicit ProbeRecord(const ProbeSet& probes) : probes_(probes) {}

  /// To be called with the last state of every step, before values(). Collective.
  void step_ended(int step, Snapshot& snapshot);
  /// Collective.
  ProbeValues values(Snapshot& snapshot) const;
  /// The same of a converged increment, with the peaks so far, which it may be one of. Collective.
  ProbeValues increment_ended(Snapshot& snapshot);
  /// `ended`: how many steps have. Collective.
  void serialize(Archive& archive, int ended);

 private:
  struct Start {
    std::vector<double> x;
    std::map<std::size_t, double> values;
  };
  double value(std::size_t i, Snapshot& snapshot, const Start& start) const;

  const ProbeSet& probes_;
  std::map<int, Start> starts_;
  std::map<std::size_t, double> peaks_;
};

}  // namespace bulbus::inline problem
