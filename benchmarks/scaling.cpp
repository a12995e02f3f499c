// One linear system of the half eye on as many ranks as there are: seconds, memory and messages of a Krylov
// iteration. The first of the inflation, to 1e-6, in meshes of `-n`, refined `--refine` times.
#include "benchmarks/common.hpp"
#include "benchmarks/half_eye.hpp"
#include "core/base/memory.hpp"
#include "precond/make_preconditioner.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

constexpr double tolerance = 1e-6;

// Largest over the ranks of what this one has sent since `before`, for each of `iterations`.
json traffic_since(const Traffic& before, int iterations, const Comm& comm) {
  const Traffic now = traffic();
  const auto each = [&](long long total) { return comm.max(static_cast<double>(total) / iterations); };
  return {{"messages", each(now.messages - before.messages)},
          {"kb", 1e-3 * each(now.bytes - before.bytes)},
          {"reductions", each(now.reductions - before.reductions)}};
}

json solve_one(int n, int refine, const Comm& comm) {
  const double start = Clock::now();
  auto problem = half_eye(n, comm, refine);
  const double made = Clock::now();
  LinearSettings settings;
  settings.take_mesh(refine);
  Profiler profiler;
  State state = problem->initial_state();
  problem->begin_step(0, state);
  problem->set_progress(1, state);
  const Residual r = problem->residual(state);
  const auto system = std::make_shared<const CoupledSystem>(*problem, settings, state, r);
  auto solver = make_solver(settings, profiler);
  const double linearised = Clock::now();
  const Preparation ready = solver->prepare(system);
  if (!ready.ok) return {{"n", n}, {"refine", refine}, {"ranks", comm.size()}, {"reason", ready.reason}};
  const std::vector<double> prescribed(state.x.size());
  const CoupledOperator A(system, ready.augmentation);
  const auto b = A.right_hand_side(r, prescribed);
  std::vector<double> x(system->size());
  const double prepared = Clock::now();
  const Traffic before = traffic();
  const LinearReport report = solver->solve(A, b, x, tolerance);
  const double solved = Clock::now();
  const int iterations = std::max(report.iterations, 1);
  json row{{"n", n},
           {"refine", refine},
           {"ranks", comm.size()},
           {"hexahedra", problem->mesh().all_hexes},
           {"unknowns", unknowns(*problem)},
           {"iterations", report.iterations},
           {"mesh_s", comm.max(made - start)},
           {"setup_s", comm.max(prepared - linearised)},
           {"iteration_ms", 1e3 * comm.max(solved - prepared) / iterations},
           {"peak_mb", 1e-6 * comm.max(static_cast<double>(peak_resident_bytes()))},
           {"ghosts", comm.max(static_cast<double>(problem->mesh().nodes() - problem->mesh().owned))},
           {"reason", report.ok ? "" : report.reason}};
  row["us_per_unknown"] =
      1e3 * row["iteration_ms"].get<double>() * comm.size() / row["unknowns"].get<double>();
  row.update(traffic_since(before, iterations, comm));
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Session session(argc, argv);
  const Comm comm;
  const Options o = parse(argc, argv, {14}, {4}, 1);
  json report = new_report("scaling", o, comm.size());
  report["notes"] =
      "wall-clock seconds, the slowest rank's; of each Krylov iteration the messages to other ranks, their "
      "kB and the global sums; "
      "the factorised base mesh's own messages are not counted; peak MB of the largest rank";
  for (int n : o.sizes) report["rows"].push_back(solve_one(n, o.refine, comm));
  if (comm.rank() == 0)
    finish(report,
           {"ranks", "n", "refine", "hexahedra", "unknowns", "iterations", "setup_s", "iteration_ms",
            "us_per_unknown", "messages", "kb", "reductions", "peak_mb"},
           o);
}
