// What a Problem takes into a checkpoint, and how it comes back to where it was.
#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

void Problem::serialize(Archive& archive) {
  dofs_->serialize(archive);
  for (Liquid& l : liquids_) l.serialize(archive);
  for (const auto& term : terms()) term->serialize(archive);
  if (!coarser_ || !archive.knows("coarser")) return;  // kept by a run that had no use for the coarser meshes
  const Archive::Group group(archive, "coarser");
  coarser_->serialize(archive);
}

void Problem::go_through(int steps) {
  State state = initial_state();
  std::vector<double> prescribed(state.x.size());
  for (int k = 0; k < steps; ++k) {
    begin(k, state, &Term::pass_step);
    dofs_->prescribed_increment(state, 1, prescribed);
    for (std::size_t i = 0; i < prescribed.size(); ++i) state.x[i] += prescribed[i];
    end_step();
  }
}

void Problem::rehearse(int steps) {
  go_through(steps);
  added_.clear();
  renew();
}

void Problem::renew() {
  loads_.clear();
  fading_.clear();
  step_ = -1;
  s_ = 0;
  build();
  if (coarser_) coarser_->renew();
}

// Read twice: the step builds on the constraints before it, and its begin changes what was kept later.
void Problem::resume(int step, const State& start, double s, State& now, Archive& kept) {
  go_through(step);
  serialize(kept);
  begin_step(step, start);
  set_progress(s, now);
  serialize(kept);
}

}  // namespace bulbus::inline problem
