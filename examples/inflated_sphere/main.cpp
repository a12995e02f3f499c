// A thick sphere full of liquid, an octant of it, blown up by 15 mmHg: the library called from a program of
// one's own.
#include <cstdio>

#include "core/mesh/generate/generate.hpp"
#include "core/problem/problem.hpp"
#include "core/solve/march.hpp"
#include "precond/make_preconditioner.hpp"

int main(int argc, char** argv) {
  const bulbus::Session session(argc, argv);  // MPI
  const bulbus::Mesh mesh =
      bulbus::generate(bulbus::ShellShape{.inner = 10, .outer = 11, .n = 6, .layers = 2});

  bulbus::Model model;
  model.regions["shell"].c10 = .05;  // MPa
  model.liquids["inside"].surface = "inner";
  model.symmetry = {"x", "y", "z"};
  bulbus::StepSpec inflate;
  inflate.name = "inflate";
  inflate.pressures["inside"] = "1.99984e-3";  // MPa
  model.steps = {inflate};

  bulbus::Problem problem(mesh, model, {});
  bulbus::State state = problem.initial_state();
  bulbus::SolverSettings settings;
  bulbus::Profiler profiler;
  bulbus::MarchObserver observer;
  const auto solver = bulbus::make_krylov_solver(
      settings.linear, bulbus::make_preconditioner_factory(settings.linear, profiler), profiler);
  const bulbus::MarchReport report = bulbus::march(problem, *solver, state, settings, profiler, observer);

  const int node = problem.mesh().local(bulbus::nodes_of(mesh, "outer")).front();
  const double* x = &state.x[3 * node];
  std::printf("%s, %d Newton iterations, outer radius %.4f mm\n",
              report.converged ? "converged" : report.reason.c_str(), report.newton_iterations,
              bulbus::norm(bulbus::Vec3<double>{x[0], x[1], x[2]}));
  return report.converged ? 0 : 1;
}
