#include "core/solve/settings.hpp"

#include "core/base/memory.hpp"

namespace bulbus::inline solve {

// Multigrid bears more augmentation than aggregation does, and pressures then need fewer iterations; K of
// softened lines bears more weight. What the default of each setting rests on is in benchmarks/notebook:
// displacement_block.md (γ, nodes and degrees), checkerboard_modes.md (pressures), reuse.md (coarse_change).
void LinearSettings::take_mesh(int refinements) {
  if (refinements == 0) return;
  gamma = 12;
  pressures.weight = .3;
}

Displacement LinearSettings::displacement_on(bool refined) const {
  if (displacement != Displacement::automatic) return displacement;
  return refined ? Displacement::multigrid : Displacement::aggregation;
}

bool LinearSettings::wants_hierarchy() const {
  return method == Method::iterative && displacement_on(true) == Displacement::multigrid;
}

double LinearSettings::allowed_mb() const {
  return memory_limit.value_or(1e-6 * static_cast<double>(machine_bytes()));
}

std::string SolverSettings::accuracy_help() {
  return "defaults of the settings below; against a converged solution on the same mesh, the operation's "
         "figures (encircling.yaml) are "
         "within 2 % with fast, 0.2 % with balanced, 0.01 % with tight";
}

// docs/trade.md measures what they promise, tests/scenes/accuracy_test.cpp asserts it.
void SolverSettings::take_preset() {
  if (accuracy == Accuracy::tight) return;  // the structs' own defaults
  linear.reuse = 2;
  if (accuracy == Accuracy::balanced) {
    newton.force = newton.volume = 1e-5, newton.liquid = 1e-6;
    newton.intermediate = 200;  // from 1000 on, runs end with another point in contact now and then
  } else {  // a node more or less in contact is per cents of the area: the end must be as strict as that of
            // tight
    newton.force = newton.liquid = 1e-6, newton.volume = 1e-5;
    newton.eta_max = 3e-3;
    stepping.increments = .25;
  }
}

}  // namespace bulbus::inline solve
