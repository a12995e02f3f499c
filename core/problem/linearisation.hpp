#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/element/solid_tangent.hpp"
#include "core/problem/term.hpp"

namespace bulbus::inline problem {

/// The tangents of all that a problem is a sum of, in one state: a value that the next linearisation leaves
/// as it is. Those of liquids need their surfaces and the state alone.
struct Linearisation {
  std::shared_ptr<const State> state;
  SolidTangent solid;
  std::vector<std::shared_ptr<const TermTangent>> terms;  ///< of Problem::terms(), null where there is none
  int added;                                              ///< the first of a term from a floor above

  /// Relative residual to which a linear solve must come at least. The same on every rank.
  double solve_tolerance() const;
};

}  // namespace bulbus::inline problem
