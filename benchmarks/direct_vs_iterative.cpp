// The half eye from rest through 15 mmHg to the first coupled increment (0.5 mm), by the direct and by the
// iterative solver, on growing meshes; how time and memory grow; and what the direct solver would need where
// it does not fit. Each size and method runs as a process of its own, so that peak memory is its own.
//
//     bench_direct_vs_iterative [-n CELLS,...] [--refine TIMES] [-r REPETITIONS] [--memory MB] [-o FILE]
//
// --memory: the limit of a factorisation.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "benchmarks/child.hpp"
#include "benchmarks/half_eye.hpp"
#include "benchmarks/timed_solver.hpp"
#include "core/io/json_file.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

json run(const std::vector<std::string>& words) {
  const double start = cpu_seconds();
  const std::string& method = words.at(0);
  const int n = std::stoi(words.at(1));
  const Comm comm;
  const int refine = std::stoi(words.at(3));
  SolverSettings settings = settings_of(method, std::stod(words.at(2)));
  if (method == "iterative") settings.linear.take_mesh(refine);
  Profiler profiler;
  auto problem = half_eye(n, comm, refine);
  TimedSolver solver(make_solver(settings.linear, profiler));
  State state = problem->initial_state();
  json row{{"n", n},
           {"refined", refine},
           {"method", method},
           {"hexahedra", problem->mesh().all_hexes},
           {"unknowns", unknowns(*problem)}};
  for (auto [step, progress] : {std::pair{0, 1.}, {1, .25}}) {
    problem->begin_step(step, state);
    const NewtonReport report =
        newton(*problem, settings.linear, solver, state, progress, settings.newton, profiler);
    row["newton_iterations"].push_back(report.iterations.size());
    if (report.outcome != Outcome::converged) {
      row["reason"] = report.reason;
      break;
    }
    for (const auto& term : problem->terms()) term->commit(state);
    if (step == 0) problem->end_step();
  }
  profiler.memory.set("mesh", problem->mesh().bytes());
  std::vector<double> whole;
  for (std::size_t i = 0; i < solver.solution.size(); ++i)
    whole.push_back(solver.setup[i] + solver.solution[i]);
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
  if (solver.factor) {
    row["estimated_mb"] = solver.factor->estimated_mb;
    row["estimated_gflop"] = 1e-9 * solver.factor->estimated_flops;
    row["too_large"] = solver.factor->too_large;
  }
  for (const auto& [part, bytes] : profiler.memory.peaks()) row["memory_mb"][part] = 1e-6 * bytes;
  return row;
}

// Of several runs, the one with the median time of a linear solve; the others' figures are kept beside it.
json median_run(const std::string& method, int n, int refine, int repetitions, double memory_mb) {
  std::vector<json> rows;
  for (int r = 0; r < repetitions; ++r) {
    rows.push_back(
        row_of_child({method, std::to_string(n), std::to_string(memory_mb), std::to_string(refine)}));
    rows.back().update({{"n", n}, {"method", method}});
  }
  std::ranges::sort(rows, {}, [](const json& row) { return row.value("linear_s", 0.); });
  json row = rows[rows.size() / 2];
  for (const json& other : rows) row["linear_s_of_runs"].push_back(other.value("linear_s", 0.));
  return row;
}

// Iterative over direct; where the direct solver does not fit, its memory by estimate.
json ratio(const json& iterative, const json& direct) {
  json r{{"n", iterative["n"]}, {"unknowns", iterative["unknowns"]}};
  const auto over = [&](const char* key, const json& value) {
    r[key] = iterative[key].get<double>() / value.get<double>();
  };
  if (direct.contains("reason")) return over("peak_mb", direct["estimated_mb"]), r["direct"] = "estimated", r;
  for (const char* key : {"linear_s", "total_s", "peak_mb"}) over(key, direct[key]);
  return r["direct"] = "measured", r;
}

// p of figure ~ unknowns^p, by least squares of the logarithms over the rows of a method, from a size on,
// that have the figure.
json growth(const json& rows, const std::string& method, int from) {
  json g{{"method", method}, {"from_n", from}};
  for (const char* key :
       {"setup_s", "solve_s", "linear_s", "total_s", "peak_mb", "estimated_mb", "estimated_gflop"}) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const json& row : rows) {
      const bool estimate = std::string(key).starts_with("estimated");
      if (row["method"] != method || row["n"] < from || row.value(key, 0.) <= 0 ||
          (row.contains("reason") && !estimate))
        continue;
      const double a = std::log(row["unknowns"].get<double>()), b = std::log(row[key].get<double>());
      n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    if (n > 1) g[key] = (n * xy - x * y) / (n * xx - x * x);
  }
  return g;
}

// Over all sizes, and over the larger half of them, where what every process holds does not matter any more.
json growths(const json& rows, std::vector<int> sizes) {
  json all = json::array();
  std::ranges::sort(sizes);
  for (const char* method : {"iterative", "direct"})
    for (int from : {sizes[0], sizes[sizes.size() / 2]})
      if (json g = growth(rows, method, from); g.contains("setup_s")) all.push_back(g);
  return all;
}

double memory_limit_in(const Options& o) {
  if (o.rest.empty()) return 20000;
  if (o.rest.size() != 2 || o.rest[0] != "--memory")
    throw std::invalid_argument("unknown option " + o.rest[0]);
  return std::stod(o.rest[1]);
}

bool failed(const json& row) { return row.contains("reason") && !row.value("too_large", false); }

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  if (ran_as_child(argc, argv, run)) return 0;
  const Options o = parse(argc, argv, {4, 8, 14, 20, 28}, {4, 6}, 3);
  const double memory_mb = memory_limit_in(o);
  json report = new_report("direct_vs_iterative", o);
  const SolverSettings s;
  report["parameters"].update({{"displacement", word_of(s.linear.displacement)},
                               {"gamma", s.linear.gamma},
                               {"operator", word_of(s.linear.op)},
                               {"restart", s.linear.restart},
                               {"degree", s.linear.degree},
                               {"aggregates", s.linear.aggregates},
                               {"eta_max", s.newton.eta_max},
                               {"direct_gamma", 0},
                               {"memory_limit_mb", memory_mb}});
  report["notes"] =
      "seconds are processor time; linear_s: median over the linear solves of set-up (or factorisation) and "
      "solution, "
      "in the run that is the median of the repetitions; peak_mb: VmHWM of the process; estimated: by "
      "MUMPS's analysis; "
      "growth: p of unknowns^p by least squares, from size n on";
  for (int n : o.sizes) {
    const int cells = n << o.refine;
    const json iterative = median_run("iterative", n, o.refine, cells > 40 ? 1 : o.repetitions, memory_mb);
    const json direct = median_run("direct", n, o.refine, cells > 20 ? 1 : o.repetitions, memory_mb);
    report["rows"].push_back(iterative);
    report["rows"].push_back(direct);
    if (!failed(iterative) && !failed(direct)) report["ratios"].push_back(ratio(iterative, direct));
    report["growth"] = growths(report["rows"], o.sizes);
    if (!o.out.empty()) write_json(o.out, report);  // what is measured so far
  }
  finish(report,
         {"n", "unknowns", "method", "linear_solves", "krylov", "setup_s", "solve_s", "linear_s", "total_s",
          "peak_mb", "estimated_mb", "reason"},
         o);
  std::printf("iterative / direct\n");
  print_table(report["ratios"], {"n", "unknowns", "direct", "linear_s", "total_s", "peak_mb"});
  std::printf("powers of the unknowns\n");
  print_table(report["growth"], {"method", "from_n", "setup_s", "solve_s", "linear_s", "total_s", "peak_mb",
                                 "estimated_mb", "estimated_gflop"});
  return std::ranges::any_of(report["rows"], failed);
}
