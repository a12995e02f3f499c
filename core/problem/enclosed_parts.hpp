#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

/// Connected parts of the deformable hexahedra whose volume the constraints of a step fix: no free motion
/// changes it, Σ_e ∂V_e/∂x vanishes on all free directions. Their pressures are then determined up to one
/// number a part, which is left as it was.
class EnclosedParts {
 public:
  /// None.
  EnclosedParts() = default;
  /// Of the step that begins in `start`, its constraints built. Throws InputError where a part's walls leave
  /// more or less room than it has volume. Collective.
  EnclosedParts(const Problem& problem, const State& start, int step);

  bool any() const { return !names_.empty(); }
  /// A sentence for every part.
  std::vector<std::string> sentences() const;
  /// Shifts the pressures of every part by one number: their mean is what it was at the start of the step.
  /// Collective.
  void settle(std::span<double> lambda) const;
  /// Compressibility, mm³/MPa, by which a factorisation tells the undetermined pressure of a local
  /// hexahedron; 0 elsewhere.
  double compliance(int hex) const { return part_.empty() || part_[hex] < 0 ? 0 : compliance_[hex]; }

 private:
  std::vector<double> means(std::span<const double> lambda) const;

  const Problem* problem_ = nullptr;
  std::vector<std::string> names_;
  std::vector<double> volume_, mean_;  // of every part
  std::vector<int> part_;              // of every local hexahedron, −1: none of them
  std::vector<double> compliance_;
};

}  // namespace bulbus::inline problem
