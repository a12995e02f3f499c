#include "benchmarks/half_eye.hpp"

#include <stdexcept>

#include "app/eye/eye.hpp"
#include "core/mesh/refine.hpp"
#include "precond/make_preconditioner.hpp"

namespace bulbus::bench {
namespace {

constexpr auto mmhg_15 = "1.99984e-3";  // MPa

}  // namespace

Model half_eye_model() {
  Model m;
  for (const auto& [region, c10] : std::map<std::string, double>{{"cornea", .0333},
                                                                 {"sclera", .0833},
                                                                 {"ciliary_body", .01},
                                                                 {"choroid", .0083},
                                                                 {"retina", .0008},
                                                                 {"optic_nerve", .05},
                                                                 {"lens", 1.}})
    m.regions[region].c10 = c10;
  m.bars["zonules"] = {};
  m.liquids["vitreous"] = {.surface = "cavity", .K = 2083.3};
  m.symmetry = {"x"};
  m.fix = {{.set = "nerve_end"}};
  StepSpec pressurise{.name = "pressurise"}, indent{.name = "indent", .increments = 4};
  pressurise.pressures["vitreous"] = mmhg_15;
  indent.enclose = {"vitreous"};
  DisplaceSpec band{.set = "equator_band", .radial = "-2"};
  band.from = "start";
  indent.displace = {band};
  m.steps = {pressurise, indent};
  return m;
}

std::unique_ptr<Problem> half_eye(int n, const Comm& comm, int refine) {
  EyeSettings settings;
  settings.n = n;
  return std::make_unique<Problem>(refined(generate(settings), refine), half_eye_model(), comm);
}

State pressurised(Problem& problem, const SolverSettings& settings, Profiler& profiler) {
  auto solver =
      make_krylov_solver(settings.linear, make_preconditioner_factory(settings.linear, profiler), profiler);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  const NewtonReport report = newton(problem, settings.linear, *solver, state, 1, settings.newton, profiler);
  if (report.outcome != Outcome::converged)
    throw std::runtime_error("15 mmHg was not reached: " + report.reason);
  for (const auto& term : problem.terms()) term->commit(state);
  problem.end_step();
  return state;
}

FirstIncrement first_increment(Problem& problem, State& state) {
  constexpr double part = .25;
  problem.begin_step(1, state);
  problem.set_progress(part, state);
  FirstIncrement start{problem.residual(state), std::vector<double>(state.x.size())};
  problem.dofs().prescribed_increment(state, part, start.prescribed);
  return start;
}

long long unknowns(const Problem& problem) {
  return 3 * problem.mesh().all_nodes + problem.mesh().all_hexes +
         static_cast<long long>(problem.liquids().size()) +
         6 * static_cast<long long>(problem.dofs().bodies().size());
}

}  // namespace bulbus::bench
