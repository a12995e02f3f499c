// Preconditioners of the displacement block: the half eye at 15 mmHg, the linear system of the first coupled
// increment (0.5 mm).
#include "benchmarks/common.hpp"
#include "benchmarks/half_eye.hpp"
#include "benchmarks/timed_solver.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

constexpr double tolerance = 1e-6;
const std::vector<std::string> methods{"aggregation",     "hybrid", "multigrid", "scalar_amg", "boomeramg",
                                       "boomeramg_nodal", "jacobi", "exact",     "direct"};

json solve_by(const std::string& method, Problem& problem, const State& state, const Residual& r,
              std::span<const double> prescribed, LinearSettings settings) {
  if (method == "direct")
    settings = bench::settings_of(method, settings.memory_limit.value_or(0)).linear;
  else
    settings.displacement = from_word<Displacement>(method);
  json row{{"displacement", method},
           {"gamma", settings.gamma},
           {"hexahedra", problem.mesh().all_hexes},
           {"unknowns", unknowns(problem)}};
  Profiler profiler;
  const auto system = std::make_shared<const CoupledSystem>(problem, settings, state, r);
  auto solver = make_solver(settings, profiler);
  const double start = cpu_seconds();
  const Preparation ready = solver->prepare(system);
  const double prepared = cpu_seconds();
  row["setup_s"] = prepared - start;
  if (!ready.ok) return row["reason"] = ready.reason, row;
  const CoupledOperator A(system, ready.augmentation);
  const auto b = A.right_hand_side(r, prescribed);
  std::vector<double> x(system->size());
  const LinearReport report = solver->solve(A, b, x, tolerance);
  row["solve_s"] = cpu_seconds() - prepared;
  row["iterations"] = report.iterations;
  row["reduction"] = report.reduction;
  row["reason"] = report.ok ? "" : report.reason;
  for (const auto& [part, bytes] : profiler.memory.peaks()) row["memory_mb"][part] = 1e-6 * bytes;
  row["mb"] = row["memory_mb"].value(method == "direct" ? "factor" : "preconditioner", 0.);
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Session session(argc, argv);
  const Comm comm;
  Options o = parse(argc, argv, {14}, {4}, 1);
  const auto& chosen = o.rest.empty() ? methods : o.rest;  // `bench_precond hybrid exact`: these only
  SolverSettings settings;
  settings.linear.take_mesh(o.refine);
  settings.linear.fallback = Fallback::none;  // a preconditioner that fails shall say so
  json report = new_report("precond", o, comm.size());
  for (auto [key, value] : {std::pair<const char*, json>{"gamma", settings.linear.gamma},
                            {"tolerance", tolerance},
                            {"restart", settings.linear.restart},
                            {"max_iterations", settings.linear.max_iterations},
                            {"degree", settings.linear.degree},
                            {"smoothing_range", settings.linear.smoothing_range},
                            {"aggregates", settings.linear.aggregates},
                            {"operator", word_of(settings.linear.op)}})
    report["parameters"][key] = value;
  report["notes"] =
      "seconds are processor time; iterations to the tolerance in the scaled norm; mb without the Krylov "
      "basis";
  for (int n : o.sizes) {
    auto problem = half_eye(n, comm, o.refine);
    Profiler profiler;
    if (o.refine > 0) settings.linear.displacement = Displacement::multigrid;
    State state = pressurised(*problem, settings, profiler);
    const auto [r, prescribed] = first_increment(*problem, state);
    for (const std::string& method : chosen) {
      if (method == "multigrid" && o.refine == 0) continue;
      report["rows"].push_back(solve_by(method, *problem, state, r, prescribed, settings.linear));
      report["rows"].back()["n"] = n;
    }
  }
  if (comm.rank() == 0)
    finish(report,
           {"n", "unknowns", "displacement", "iterations", "setup_s", "solve_s", "mb", "reduction", "reason"},
           o);
}
