#pragma once
#include "core/problem/term.hpp"

namespace bulbus {

inline std::shared_ptr<const TermTangent> tangent_at(const Term& term, const State& state) {
  return term.tangent(std::make_shared<const State>(state));
}

inline std::vector<double> action(const TermTangent& tangent, std::span<const double> d) {
  std::vector<double> f(d.size());
  tangent.add_action(d, f);
  return f;
}

/// Zeros of a term without a tangent.
inline std::vector<double> action(const Term& term, const State& state, std::span<const double> d) {
  const auto tangent = tangent_at(term, state);
  return tangent ? action(*tangent, d) : std::vector<double>(d.size());
}

/// Tells a term of a Newton step by dx, found with its tangent at a state.
inline void step_from(const State& state, std::span<const double> dx, Term& term) {
  term.predict(*tangent_at(term, state), dx);
}

}  // namespace bulbus
