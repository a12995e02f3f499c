#pragma once
#include <memory>
#include <span>
#include <string>

#include "core/element/contribution.hpp"
#include "core/problem/state.hpp"

namespace bulbus::inline problem {

/// The derivative of a term's residual in one state, a value: it shares all that it is applied with.
class TermTangent {
 public:
  virtual ~TermTangent() = default;
  /// force += tangent · dx
  virtual void add_action(std::span<const double> dx, std::span<double> force) const = 0;
  virtual void visit(const ContributionVisitor& visitor) const = 0;
  /// Relative residual to which a linear solve with it must come at least: stiff terms may need a better one
  /// than Newton's method asks for. The same on every rank.
  virtual double solve_tolerance() const { return 1; }
};

/// One addend of the equilibrium that acts on nodal displacements alone. Nodal vectors have 3 numbers per
/// local node and are added to; forces are internal minus external (zero in sum at equilibrium).
class Term {
 public:
  virtual ~Term() = default;

  /// force += residual; reference_force (per local node, may be empty) += |contribution|, the reference norm
  /// of the balance.
  virtual void add_residual(const State& state, std::span<double> force,
                            std::span<double> reference_force) const = 0;
  /// The tangent at a state; null where the residual is the same in all of them. Collective.
  virtual std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>&) const {
    return nullptr;
  }
  /// Is the tangent symmetric on the free unknowns?
  virtual bool symmetric() const { return true; }

  /// A step begins from a converged state. Collective.
  virtual void begin_step(int, const State&) {}
  /// A step begins that is not solved: in a rehearsal, or on the way back to a later one. Collective.
  virtual void pass_step(int step, const State& start) { begin_step(step, start); }
  /// Newton's method moves the local nodes by dx, which it found with `tangent`, of this term. What is active
  /// may depend on what that predicts. Collective.
  virtual void predict(const TermTangent& /*tangent*/, std::span<const double> /*dx*/) {}
  /// Newton has converged for what the term holds fixed meanwhile (multipliers, active set): true if that has
  /// to change first, so that Newton goes on. Collective.
  virtual bool update_multipliers(const State&) { return false; }
  /// Newton has converged: why the state must not be accepted all the same; empty: it may. Collective.
  virtual std::string refusal(const State&) const { return {}; }
  /// Loads follow the part s of the step done; freeze() keeps the end of the step for the next ones.
  virtual void set_progress(double) {}
  virtual void freeze() {}
  /// The increment that follows begins where the last two converged states point to, `factor` times the way
  /// between them farther. Comes before set_progress().
  virtual void extrapolate(double /*factor*/) {}
  /// What the term remembers follows the increments: kept when one has converged, what it was then when one
  /// is cut.
  virtual void commit(const State&) {}
  virtual void roll_back() {}
  /// All that the term has from increments before, but for what begin_step() and set_progress() make anew:
  /// for a checkpoint. Read after the step has begun and its progress is set. Collective.
  virtual void serialize(Archive&) {}
};

}  // namespace bulbus::inline problem
