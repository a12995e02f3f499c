// The half eye from rest through 15 mmHg to the first coupled increment (0.5 mm), by the direct and by the
// iterative solver, on growing meshes; how time and memory grow; and what the direct solver would need where
// it does not fit. Each size and solver runs as a process of its own, so that peak memory is its own.
//
//     bench_direct_vs_iterative [-n CELLS,...] [--refine TIMES] [-r REPETITIONS] [--memory MB] [-o FILE]
//                               [--variants NAME,... | all]
//
// --memory: the limit of a factorisation. --variants: benchmarks/variants.hpp; all: those of variants.cpp.
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

void add_factor(const TimedSolver& solver, json& row) {
  const FactorReport& f = *solver.factor;
  row["ordering"] = f.ordering;
  row["estimated_mb"] = f.estimated_mb;
  row["estimated_gflop"] = 1e-9 * f.estimated_flops;
  row["too_large"] = f.too_large;
  row["analysis_s"] = solver.analysis;
  row["factorisation_s"] = median(solver.factorisation);
  row["factor_entries"] = f.factor_entries;
  row["gflop"] = 1e-9 * f.flops;
  row["factor_mb"] = f.memory_mb;
  if (f.ok && f.negative_pivots >= 0) row["nonpositive"] = f.nonpositive();
}

json run(const std::vector<std::string>& words) {
  const double start = cpu_seconds();
  const std::string& method = words.at(0);
  const int n = std::stoi(words.at(1));
  const Comm comm;
  const int refine = std::stoi(words.at(3));
  SolverVariant variant = solver_variant(method, std::stod(words.at(2)));
  SolverSettings& settings = variant.settings;
  if (!variant.direct()) settings.linear.take_mesh(refine);
  Profiler profiler;
  auto problem = half_eye(n, comm, refine);
  TimedSolver solver(make_solver(settings.linear, profiler));
  State state = problem->initial_state();
  json row{{"n", n},
           {"refined", refine},
           {"method", method},
           {"ranks", variant.ranks},
           {"threads", variant.threads},
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
  row["wall_s"] = median(solver.wall);
  if (!solver.reductions.empty()) row["reduction"] = std::ranges::max(solver.reductions);
  row["total_s"] = cpu_seconds() - start;
  row["linear_solves"] = solver.solution.size();
  row["iterations"] = solver.iterations;
  row["reductions"] = solver.reductions;
  int krylov = 0;
  for (int i : solver.iterations) krylov += i;
  row["krylov"] = krylov;
  row["peak_mb"] = 1e-6 * comm.sum(static_cast<double>(peak_resident_bytes()));
  if (solver.factor) add_factor(solver, row);
  for (const auto& [part, bytes] : profiler.memory.peaks()) row["memory_mb"][part] = 1e-6 * bytes;
  return row;
}

// Of several runs, the one with the median time of a linear solve; the others' figures are kept beside it.
json median_run(const std::string& method, int n, int refine, int repetitions, double memory_mb) {
  std::vector<json> rows;
  const SolverVariant variant = solver_variant(method, memory_mb);
  for (int r = 0; r < repetitions; ++r) {
    rows.push_back(
        row_of_child({method, std::to_string(n), std::to_string(memory_mb), std::to_string(refine)},
                     variant.ranks, variant.threads));
    rows.back().update({{"n", n}, {"method", method}});
  }
  std::ranges::sort(rows, {}, [](const json& row) { return row.value("linear_s", 0.); });
  json row = rows[rows.size() / 2];
  for (const json& other : rows) row["linear_s_of_runs"].push_back(other.value("linear_s", 0.));
  return row;
}

// Iterative over direct; where the direct solver does not fit, its memory by estimate.
json ratio(const json& iterative, const json& direct) {
  json r{{"n", iterative["n"]}, {"unknowns", iterative["unknowns"]}, {"method", direct["method"]}};
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
json growths(const json& rows, std::vector<int> sizes, const std::vector<std::string>& variants) {
  json all = json::array();
  std::ranges::sort(sizes);
  for (const std::string& method : variants)
    for (int from : {sizes[0], sizes[sizes.size() / 2]})
      if (json g = growth(rows, method, from); g.contains("setup_s")) all.push_back(g);
  return all;
}

struct Choice {
  double memory_mb = 20000;
  std::vector<std::string> variants{"iterative", "direct"};
};

Choice choice_in(const std::vector<std::string>& words) {
  Choice c;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    if (i + 1 == words.size()) throw std::invalid_argument(words[i] + " lacks its value");
    if (words[i] == "--memory")
      c.memory_mb = std::stod(words[i + 1]);
    else if (words[i] == "--variants")
      c.variants = variants_in(words[i + 1]);
    else
      throw std::invalid_argument("unknown option " + words[i]);
  }
  return c;
}

bool failed(const json& row) { return row.contains("reason") && !row.value("too_large", false); }

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  if (ran_as_child(argc, argv, run)) return 0;
  const Options o = parse(argc, argv, {4, 8, 14, 20, 28}, {4, 6}, 3);
  const auto [memory_mb, variants] = choice_in(o.rest);
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
      "seconds are processor time, of one rank with all its threads; linear_s: median over the linear solves "
      "of "
      "set-up (or factorisation) and solution, in the run that is the median of the repetitions; wall_s: the "
      "same "
      "by the clock; peak_mb: VmHWM of the process, summed over ranks; estimated: by MUMPS's analysis, which "
      "is "
      "made once for a pattern; reduction: the largest residual of a linear solve over its right-hand side; "
      "growth: p of unknowns^p by least squares, from size n on";
  for (int n : o.sizes) {
    const int cells = n << o.refine;
    json iterative;
    for (const std::string& method : variants) {
      const bool direct = solver_variant(method, 0).direct();
      const json row =
          median_run(method, n, o.refine, cells > (direct ? 20 : 40) ? 1 : o.repetitions, memory_mb);
      report["rows"].push_back(row);
      if (method == "iterative") iterative = row;
      const bool comparable = !row.contains("reason") || row.value("estimated_mb", 0.) > 0;
      if (direct && comparable && !iterative.is_null() && !failed(iterative) && !failed(row))
        report["ratios"].push_back(ratio(iterative, row));
      if (!o.out.empty()) write_json(o.out, report);  // what is measured so far
    }
    report["growth"] = growths(report["rows"], o.sizes, variants);
  }
  finish(
      report,
      {"n", "unknowns", "method", "linear_solves", "krylov", "analysis_s", "setup_s", "solve_s", "linear_s",
       "wall_s", "total_s", "peak_mb", "factor_entries", "gflop", "reduction", "nonpositive", "reason"},
      o);
  std::printf("iterative / direct\n");
  print_table(report["ratios"], {"n", "unknowns", "method", "direct", "linear_s", "total_s", "peak_mb"});
  std::printf("powers of the unknowns\n");
  print_table(report["growth"], {"method", "from_n", "setup_s", "solve_s", "linear_s", "total_s", "peak_mb",
                                 "estimated_mb", "estimated_gflop"});
  return std::ranges::any_of(report["rows"], failed);
}
