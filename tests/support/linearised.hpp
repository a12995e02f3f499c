#pragma once
#include <gtest/gtest.h>

#include "precond/make_preconditioner.hpp"
#include "precond/smoothers/line_jacobi.hpp"
#include "tests/support/models.hpp"

namespace bulbus {

// A refined problem in a state of its first step, with its tangent and the settings that are its mesh's
// defaults.
struct Linearised {
  Problem problem;
  State state;
  LinearSettings settings;
  SharedSystem system;
  Linearised(const Scene& scene, int refine, double shake)
      : problem(refined(scene.mesh, refine), scene.model, Comm()),
        state(problem.initial_state()),
        settings(defaults(refine)) {
    problem.begin_step(0, state);
    problem.set_progress(.1, state);
    if (shake > 0) state = shaken(problem, state, shake, 7);
    linearise();
  }
  /// At the present state.
  void linearise() {
    system.reset();
    system = std::make_shared<const CoupledSystem>(problem, settings, state, problem.residual(state));
  }

 private:
  static LinearSettings defaults(int refine) {
    LinearSettings s;
    s.take_mesh(refine);
    return s;
  }
};

// With the lines of its displacement block.
struct WithLines : Linearised {
  std::shared_ptr<const LineJacobi> jacobi =
      std::make_shared<LineJacobi>(*system, std::make_shared<Lines>(find_lines(problem)));
  WithLines(const Scene& scene, int refine, double shake) : Linearised(scene, refine, shake) {}
};

inline Scene thin_plate() {
  Scene scene = stretched_block(4, ".1");
  scene.mesh = generate(BlockShape{.upper = {4, 4, .5}, .nx = 4, .ny = 4, .nz = 3});
  return scene;
}

inline Scene cylinder() {
  Scene scene{generate(CylinderShape{.n = 2, .rings = 1, .layers = 3}), {}};
  scene.model.regions["cylinder"] = neo_hooke(.5);
  scene.model.fix.push_back({"bottom", {"x", "y", "z"}});
  scene.model.steps = {step("rest")};
  return scene;
}

/// To 1e-6, of the first linear system. `factorised`: of AggregationSettings.
inline int iterations(const Scene& scene, int refine, Displacement displacement,
                      int factorised = AggregationSettings().factorised) {
  Linearised l(scene, refine, 0);
  l.settings.displacement = displacement;
  l.settings.aggregation.factorised = factorised;
  Profiler profiler;
  auto solver = make_krylov_solver(l.settings, make_preconditioner_factory(l.settings, profiler), profiler);
  const Residual r = l.problem.residual(l.state);
  const Preparation prepared = solver->prepare(l.system);
  EXPECT_TRUE(prepared.ok);
  const CoupledOperator A(l.system, prepared.augmentation);
  std::vector<double> prescribed(l.state.x.size()), x(l.system->size());
  l.problem.dofs().prescribed_increment(l.state, .1, prescribed);
  const LinearReport report = solver->solve(A, A.right_hand_side(r, prescribed), x, 1e-6);
  EXPECT_TRUE(report.ok) << report.reason;
  return report.iterations;
}

}  // namespace bulbus
