// The half eye from rest through 15 mmHg to the first coupled increment (0.5 mm), by the direct and by the iterative solver. Each
// size and method runs as a child process of its own, so that peak memory is its own.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "benchmarks/common.hpp"
#include "benchmarks/half_eye.hpp"
#include "core/io/json_file.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

// Seconds, iterations and reached reduction of every linear solve: set-up or factorisation, then the solution.
class Timed final : public LinearSolver {
 public:
  explicit Timed(std::unique_ptr<LinearSolver> inner) : inner_(std::move(inner)) {}
  LinearReport prepare(CoupledSystem& system) override {
    const double start = cpu_seconds();
    const LinearReport report = inner_->prepare(system);
    setup.push_back(cpu_seconds() - start);
    return report;
  }
  LinearReport solve(const CoupledSystem& system, std::span<const double> b, std::span<double> x, double tolerance) override {
    const double start = cpu_seconds();
    const LinearReport report = inner_->solve(system, b, x, tolerance);
    solution.push_back(cpu_seconds() - start);
    iterations.push_back(report.iterations);
    reductions.push_back(report.reduction);
    return report;
  }
  std::vector<double> setup, solution, reductions;
  std::vector<int> iterations;

 private:
  std::unique_ptr<LinearSolver> inner_;
};

SolverSettings settings_of(const std::string& method) {
  SolverSettings s;
  s.linear.method = method;
  if (method == "direct") s.linear.gamma = 0;  // the direct solver takes the system as it is
  return s;
}

json run(const std::string& method, int n) {
  const double start = cpu_seconds();
  const Comm comm;
  const SolverSettings settings = settings_of(method);
  Meters meters;
  auto problem = half_eye(n, comm);
  CoupledSystem system(*problem, settings.linear);
  Timed solver(method == "direct" ? make_direct_solver(settings.linear, meters)
                                  : make_krylov_solver(settings.linear, make_preconditioner_factory(settings.linear, meters), meters));
  State state = problem->initial_state();
  json row{{"n", n}, {"method", method}, {"hexahedra", problem->mesh().all_hexes}, {"unknowns", unknowns(*problem)}};
  for (auto [step, progress] : {std::pair{0, 1.}, {1, .25}}) {
    problem->begin_step(step, state);
    const NewtonReport report = newton(*problem, system, solver, state, progress, settings.newton, meters);
    row["newton_iterations"].push_back(report.iterations.size());
    if (report.outcome != Outcome::converged) {
      row["reason"] = report.reason;
      break;
    }
    for (const auto& term : problem->terms()) term->commit(state);
    if (step == 0) problem->end_step();
  }
  meters.memory.set("mesh", problem->mesh().bytes());
  meters.memory.set("solid", problem->solid().bytes());
  meters.memory.set("operator cache", problem->solid().cache_bytes());
  meters.memory.set("coupled system", system.bytes());
  std::vector<double> whole;
  for (std::size_t i = 0; i < solver.solution.size(); ++i) whole.push_back(solver.setup[i] + solver.solution[i]);
  row["pressure_mmhg"] = state.P[0] / 1.3332236842e-4;
  row["setup_s"] = median(solver.setup);
  row["solve_s"] = median(solver.solution);
  row["linear_s"] = median(whole);
  row["total_s"] = cpu_seconds() - start;
  row["linear_solves"] = solver.solution.size();
  row["iterations"] = solver.iterations;
  row["reductions"] = solver.reductions;
  int krylov = 0;
  for (int i : solver.iterations) krylov += i;
  row["krylov"] = krylov;
  row["peak_mb"] = 1e-6 * peak_resident_bytes();
  for (const auto& [part, bytes] : meters.memory.peaks()) row["memory_mb"][part] = 1e-6 * bytes;
  return row;
}

// The child writes its row to a file: its standard output belongs to the libraries.
json run_as_child(const std::string& method, int n) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe"), file = std::filesystem::temp_directory_path() /
      ("bulbus_" + std::to_string(getpid()) + "_" + method + "_" + std::to_string(n) + ".json");
  const std::string command = "'" + self + "' --child " + method + " " + std::to_string(n) + " '" + file + "'";
  const int status = std::system(command.c_str());
  std::ifstream in(file);
  json row = json::parse(in, nullptr, false);
  std::filesystem::remove(file);
  if (status != 0 || row.is_discarded())
    row = {{"n", n}, {"method", method}, {"reason", "the process ended with status " + std::to_string(status)}};
  return row;
}

// Of several runs, the one with the median time of a linear solve; the others' figures are kept beside it.
json median_run(const std::string& method, int n, int repetitions) {
  std::vector<json> rows;
  for (int r = 0; r < repetitions; ++r) rows.push_back(run_as_child(method, n));
  std::ranges::sort(rows, {}, [](const json& row) { return row.value("linear_s", 0.); });
  json row = rows[rows.size() / 2];
  for (const json& other : rows) row["linear_s_of_runs"].push_back(other.value("linear_s", 0.));
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  if (argc == 5 && argv[1] == std::string("--child")) {
    Session session(argc, argv);
    return_freed_memory();
    write_json(argv[4], run(argv[2], std::stoi(argv[3])));
    return 0;
  }
  const Options o = parse(argc, argv, {8, 14}, {4}, 3);
  json report = new_report("direct_vs_iterative", o);
  const SolverSettings s;
  report["parameters"].update({{"displacement", s.linear.displacement}, {"gamma", s.linear.gamma}, {"operator", s.linear.op},
                               {"restart", s.linear.restart}, {"degree", s.linear.degree}, {"aggregates", s.linear.aggregates},
                               {"eta_max", s.newton.eta_max}, {"direct_gamma", 0}});
  report["notes"] = "seconds are processor time; linear_s: median over the linear solves of set-up (or factorisation) and solution, "
                    "in the run that is the median of the repetitions; peak_mb: VmHWM of the process";
  for (int n : o.sizes) {
    const json iterative = median_run("iterative", n, o.repetitions), direct = median_run("direct", n, n > 20 ? 1 : o.repetitions);
    report["rows"].push_back(iterative);
    report["rows"].push_back(direct);
    if (iterative.contains("linear_s") && direct.contains("linear_s"))
      report["ratios"].push_back({{"n", n}, {"unknowns", iterative["unknowns"]},
                                  {"linear_s", iterative["linear_s"].get<double>() / direct["linear_s"].get<double>()},
                                  {"total_s", iterative["total_s"].get<double>() / direct["total_s"].get<double>()},
                                  {"peak_mb", iterative["peak_mb"].get<double>() / direct["peak_mb"].get<double>()}});
    if (!o.out.empty()) write_json(o.out, report);  // what is measured so far
  }
  finish(report, {"n", "unknowns", "method", "linear_solves", "krylov", "setup_s", "solve_s", "linear_s", "total_s", "peak_mb", "reason"}, o);
  std::printf("iterative / direct\n");
  print_table(report["ratios"], {"n", "unknowns", "linear_s", "total_s", "peak_mb"});
  return std::ranges::any_of(report["rows"], [](const json& row) { return row.contains("reason"); });
}
