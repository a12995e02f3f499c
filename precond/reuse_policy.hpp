#pragma once

namespace bulbus::inline precond {

/// What settings and mesh allow.
struct ReuseLimits {
  double slowdown = 0;       ///< solver.linear.reuse
  double coarse_change = 0;  ///< solver.linear.coarse_change
  /// Have the corrections of the pressure Schur complement lines of their own? On meshes that are not refined
  /// they work with those of the displacement block.
  bool corrections_own_lines = false;
};

/// Of the linear solves since a preconditioner was set up without anything of an earlier one, in Krylov
/// iterations per digit.
struct SolveHistory {
  int solves = 0;
  double first = 0, last = 0;
  void add(double iterations_per_digit) {
    last = iterations_per_digit;
    if (solves++ == 0) first = last;
  }
};

/// From the tangent of which something was made to the present one. What is not measured yet counts as
/// unchanged, what cannot be compared as changed without bounds.
struct TangentChange {
  double largest_eigenvalue = 1;  ///< of the smoothed operator: now over then
  double coarse_rows = 0;         ///< largest change of a row of the coarsest matrix over the row's magnitude
};

/// What a preconditioner takes over from the one before it.
struct Reuse {
  bool displacement = false;    ///< the displacement block's as it is, its lines, blocks and coarse factors
  bool coarse_factors = false;  ///< those of its coarsest matrix, with the smoothers' largest eigenvalues
  bool corrections = false;     ///< of the pressure Schur complement, and the liquids' columns Â⁻¹ g
  bool anything() const { return displacement || coarse_factors || corrections; }
  bool operator==(const Reuse&) const = default;
};

/// The one place that decides on reuse (docs/decisions/012 and 013). The more of the change is known, the
/// less it allows: asked before anything is measured it says what is worth measuring.
Reuse reusable(const ReuseLimits& limits, const SolveHistory& history, const TangentChange& change);

}  // namespace bulbus::inline precond
