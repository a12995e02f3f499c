// Two forms of the coupled tangent on the half eye, by the direct and by the iterative solver: bordered,
// where the liquid's pressure is an unknown, and eliminated, where K/V_i g gᵀ fills the block of its wet
// nodes. First one linear system, that of the first coupled increment at 15 mmHg; then whole runs from rest
// to 2 mm of indentation, each in a process of its own.
//
//     bench_formulations [-n CELLS,...] [--runs CELLS] [--memory MB] [-o FILE]      whole runs up to that
//     size; limit of a factorisation
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "benchmarks/child.hpp"
#include "benchmarks/half_eye.hpp"
#include "benchmarks/timed_solver.hpp"
#include "core/io/json_file.hpp"
#include "core/solve/assemble.hpp"
#include "core/solve/march.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

constexpr double tolerance = 1e-6;  // of one iterative solve in the scaled norm
constexpr double same = 1e-8;       // largest difference of displacements of the direct solver's runs

struct Variant {
  std::string method, formulation;
};
const std::vector<Variant> variants{
    {"direct", "bordered"}, {"direct", "eliminated"}, {"iterative", "bordered"}, {"iterative", "eliminated"}};

struct Limits {
  double memory_mb = 20000;
  int runs = 14;  // largest size that whole runs are made of
};

Limits limits_in(const Options& o) {
  Limits l;
  for (std::size_t i = 0; i < o.rest.size(); i += 2) {
    if (i + 1 == o.rest.size()) throw std::invalid_argument(o.rest[i] + " needs a value");
    if (o.rest[i] == "--memory")
      l.memory_mb = std::stod(o.rest[i + 1]);
    else if (o.rest[i] == "--runs")
      l.runs = std::stoi(o.rest[i + 1]);
    else
      throw std::invalid_argument("unknown option " + o.rest[i]);
  }
  return l;
}

SolverSettings settings_of(const Variant& v, double memory_mb) {
  SolverSettings s = bench::settings_of(v.method, memory_mb);
  s.linear.formulation = from_word<Formulation>(v.formulation);
  return s;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return difference / size;
}

void add_factor(const FactorReport& f, json& row) {
  row.update({{"matrix_entries", f.matrix_entries},
              {"estimated_mb", f.estimated_mb},
              {"estimated_gflop", 1e-9 * f.estimated_flops},
              {"ordering", f.ordering},
              {"analysis_wall_s", f.seconds_analysis}});
  if (!f.ok) return;
  row.update({{"factor_entries", f.factor_entries},
              {"mb", f.memory_mb},
              {"gflop", 1e-9 * f.flops},
              {"factorisation_wall_s", f.seconds_factorisation},
              {"negative_pivots", f.negative_pivots}});
}

// The system of the first coupled increment by one variant; `solution` is its displacements.
json solved(const Variant& v, Problem& problem, const State& state, const FirstIncrement& start,
            double memory_mb, std::vector<double>& solution) {
  const SolverSettings settings = settings_of(v, memory_mb);
  Profiler profiler;
  TimedSolver solver(make_solver(settings.linear, profiler));
  const auto system = std::make_shared<const CoupledSystem>(problem, settings.linear, state, start.residual);
  reset_peak_resident();
  json row{{"method", v.method},
           {"formulation", v.formulation},
           {"hexahedra", problem.mesh().all_hexes},
           {"unknowns", unknowns(problem)},
           {"liquid_entries", liquid_entries(*system)}};
  row["wet_unknowns"] = std::ranges::count_if(system->liquid_columns()[0], [](double g) { return g != 0; });
  const Preparation ready = solver.prepare(system);
  row["setup_s"] = solver.setup[0];
  if (ready.factor) add_factor(*ready.factor, row);
  if (!ready.ok) return row["reason"] = ready.reason, row;
  std::vector<double> x(system->size());
  const CoupledOperator A(system, ready.augmentation);
  const LinearReport report =
      solver.solve(A, A.right_hand_side(start.residual, start.prescribed), x, tolerance);
  row.update({{"solve_s", solver.solution[0]},
              {"iterations", report.iterations},
              {"reduction", report.reduction},
              {"peak_mb", 1e-6 * peak_resident_bytes()}});
  for (const auto& [part, bytes] : profiler.memory.peaks()) row["memory_mb"][part] = 1e-6 * bytes;
  if (v.method == "iterative")
    row["mb"] = row["memory_mb"].value("preconditioner", 0.) + row["memory_mb"].value("Krylov basis", 0.);
  if (!report.ok) return row["reason"] = report.reason, row;
  const auto u = system->layout().primal(x);
  if (solution.empty()) solution.assign(u.begin(), u.end());
  row["difference"] = largest_difference({u.begin(), u.end()}, solution);
  return row;
}

void measure_systems(int n, double memory_mb, json& rows) {
  const Comm comm;
  auto problem = half_eye(n, comm);
  Profiler profiler;
  State state = pressurised(*problem, SolverSettings{}, profiler);
  const FirstIncrement start = first_increment(*problem, state);
  std::vector<double> solution;
  for (const Variant& v : variants) {
    rows.push_back(solved(v, *problem, state, start, memory_mb, solution));
    rows.back()["n"] = n;
  }
}

// From rest through 15 mmHg to the end of the indentation.
json whole_run(const std::vector<std::string>& words) {
  const double start = cpu_seconds();
  const Variant v{words.at(0), words.at(1)};
  const int n = std::stoi(words.at(2));
  const SolverSettings settings = settings_of(v, std::stod(words.at(3)));
  const Comm comm;
  Profiler profiler;
  auto problem = half_eye(n, comm);
  TimedSolver solver(make_solver(settings.linear, profiler));
  State state = problem->initial_state();
  MarchObserver nobody;
  const MarchReport report = march(*problem, solver, state, settings, profiler, nobody);
  json row{{"n", n},
           {"method", v.method},
           {"formulation", v.formulation},
           {"hexahedra", problem->mesh().all_hexes},
           {"unknowns", unknowns(*problem)},
           {"increments", report.increments},
           {"cuts", report.cuts},
           {"newton_iterations", report.newton_iterations},
           {"krylov_iterations", report.krylov_iterations},
           {"linear_solves", solver.solution.size()},
           {"setup_s", median(solver.setup)},
           {"solve_s", median(solver.solution)},
           {"total_s", cpu_seconds() - start},
           {"peak_mb", 1e-6 * peak_resident_bytes()},
           {"pressure_mmhg", state.P[0] / 1.3332236842e-4}};
  if (solver.factor) add_factor(*solver.factor, row);
  if (!report.converged) row["reason"] = report.reason;
  for (std::size_t i = 0; i < state.x.size(); ++i) row["u"].push_back(state.x[i] - problem->mesh().X[i]);
  return row;
}

void measure_runs(int n, double memory_mb, json& rows) {
  std::vector<double> first;
  for (const Variant& v : variants) {
    json row = row_of_child({v.method, v.formulation, std::to_string(n), std::to_string(memory_mb)});
    if (row.contains("u")) {
      const auto u = row["u"].get<std::vector<double>>();
      if (first.empty()) first = u;
      row["difference"] = largest_difference(u, first);
      row.erase("u");
    }
    row.update({{"n", n}, {"method", v.method}, {"formulation", v.formulation}});
    rows.push_back(row);
  }
}

bool wrong(const json& row) {
  if (row.contains("reason"))
    return row["method"] == "direct" &&
           row["reason"].get<std::string>().find("MB allowed") == std::string::npos;
  return row["method"] == "direct" && row["difference"] > same;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  if (ran_as_child(argc, argv, whole_run)) return 0;
  Session session(argc, argv);
  const Options o = parse(argc, argv, {8, 14}, {4}, 1);
  const Limits limits = limits_in(o);
  json report = new_report("formulations", o);
  const SolverSettings s;
  report["parameters"].update({{"memory_limit_mb", limits.memory_mb},
                               {"tolerance", tolerance},
                               {"gamma", s.linear.gamma},
                               {"restart", s.linear.restart},
                               {"force", s.newton.force},
                               {"eta_max", s.newton.eta_max}});
  report["notes"] =
      "seconds are processor time, those of MUMPS's parts wall time; matrix entries: of one triangle; liquid "
      "entries: of "
      "both, 2·3k + 1 or (3k)² + 1, 3k without what symmetry holds; peak_mb: VmHWM of the process, reset "
      "before each system; "
      "difference: of the displacements from the first row's of the same size, relative to the largest";
  report["runs"] = json::array();
  const auto save = [&] {
    if (!o.out.empty()) write_json(o.out, report);  // what is measured so far
  };
  for (int n : o.sizes) {
    measure_systems(n, limits.memory_mb, report["rows"]), save();
    if (n <= limits.runs) measure_runs(n, limits.memory_mb, report["runs"]), save();
  }
  finish(report,
         {"n", "method", "formulation", "wet_unknowns", "liquid_entries", "matrix_entries", "factor_entries",
          "estimated_mb", "mb", "peak_mb", "gflop", "setup_s", "solve_s", "iterations", "reduction",
          "negative_pivots", "difference", "reason"},
         o);
  print_table(report["runs"], {"n", "method", "formulation", "newton_iterations", "krylov_iterations",
                               "setup_s", "solve_s", "total_s", "peak_mb", "difference", "reason"});
  return std::ranges::any_of(report["rows"], wrong) || std::ranges::any_of(report["runs"], wrong);
}
