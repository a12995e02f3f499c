#pragma once
#include <string>

#include "app/records/diagnosis.hpp"
#include "contact/interactions.hpp"
#include "core/solve/march.hpp"

namespace bulbus::inline app {

/// Watches a march for what a failure may have to be explained by.
class Witness {
 public:
  explicit Witness(const Problem& problem, int stable_pivots)
      : problem_(problem), stable_pivots_(stable_pivots) {}
  /// Collective, all three.
  void step_begins(int step, const State& start);
  void increment_done(const Increment& increment, const State& state);
  void increment_cut(const NewtonReport& report);
  /// Of the last converged state. Collective.
  FailureFacts facts(const State& last, bool touching) const;

 private:
  struct Response {
    double progress = 0, volume = 0,
           displacement = 0;  // of the liquid whose pressure grows, of the nodes (rms)
  };
  Response response(double progress, const State& state) const;
  double softening() const;

  const Problem& problem_;
  int stable_pivots_ = 0, step_ = 0, liquid_ = -1, pivots_ = -1;
  bool pressure_grows_ = false;
  double end_pressure_ = 0;  // largest given one, MPa
  Response start_, first_, before_, last_;
  int done_ = 0;  // increments of the step
  Outcome outcome_ = Outcome::converged;
  std::string reason_;
};

}  // namespace bulbus::inline app
