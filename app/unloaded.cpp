#include "app/unloaded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/memory/sizes.hpp"
#include "app/records/log_columns.hpp"
#include "app/records/progress_log.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "core/problem/reference_model.hpp"
#include "precond/make_preconditioner.hpp"

namespace bulbus::inline app {
namespace {

// Problem and interactions on the same meshes after `move` has changed them.
template <class Move>
void rebuild(Prepared& prepared, Move move) {
  const Model model = prepared.problem->model();
  prepared.interactions.reset();
  auto levels = std::move(*prepared.problem).take_levels();
  prepared.problem.reset();
  move(levels);
  prepared.problem = std::make_unique<Problem>(std::move(levels), model);
  prepared.interactions = Interactions::attach(*prepared.problem, *prepared.base);
}

std::string loads_of(const ReferenceSpec& r) {
  std::string loads;
  for (const auto& [name, pressure] : r.loaded)
    loads += fmt::format("{}{} at {}", loads.empty() ? "" : ", ", name, pressure);
  if (!r.loads.empty()) loads += loads.empty() ? "loads" : ", loads";
  if (!r.displace.empty()) loads += loads.empty() ? "displacements" : ", displacements";
  return loads;
}

void tell(const Log& log, const UnloadedIteration& i, double start) {
  std::string line = fmt::format("    {:>3}  {:<6.4g}  {:.3e}     {:<7}  {:.1e}  {:>6}  {}", i.number, i.load,
                                 i.distance, i.ratio > 0 ? fmt::format("{:.2g}", i.ratio) : "", i.tolerance,
                                 i.krylov_iterations, duration(Clock::now() - start));
  if (i.negative_pivots >= 0) line += fmt::format("  {} negative pivots", i.negative_pivots);
  log.info(line);
}

UnloadedReport search(const Scene& scene, Prepared& prepared, const Log& log, Profiler& profiler) {
  const ReferenceSpec& spec = *scene.reference;
  const Model model = reference_model(prepared.problem->model(), spec);
  log.info("");
  log.info(fmt::format("unloaded reference: the mesh is drawn under {}", loads_of(spec)));
  log.info(header_of(reference_table()));
  const double start = Clock::now();
  const UnloadedSolver solver{scene.solver.linear, [&] { return make_solver(scene.solver.linear, profiler); },
                              profiler};
  UnloadedReport report;
  rebuild(prepared, [&](std::vector<MeshLevel>& levels) {
    report =
        find_unloaded(levels, model, spec, solver, [&](const UnloadedIteration& i) { tell(log, i, start); });
  });
  return report;
}

void refuse_unstable(const Problem& problem, UnloadedReport& report) {
  if (report.negative_pivots < 0 || report.negative_pivots == stable_pivots(problem)) return;
  report.found = false;
  report.reason = fmt::format(
      "the drawn state is not stable under its loads ({} negative pivots more than a stable one has): the "
      "unloaded body would snap or buckle on its way there",
      report.negative_pivots - stable_pivots(problem));
}

// All of the finest mesh at its reference positions, on the first rank.
void write_unloaded(const Prepared& prepared, const std::string& path) {
  const LocalMesh& local = prepared.problem->mesh();
  std::vector<double> mine;
  for (int n = 0; n < local.owned; ++n)
    mine.insert(mine.end(), {static_cast<double>(local.input_node[n]), local.X[3 * n], local.X[3 * n + 1],
                             local.X[3 * n + 2]});
  const auto all = local.comm.gather(std::span<const double>(mine));
  write_together(local.comm, [&] {
    if (local.comm.rank() != 0) return;
    Mesh mesh = MeshHierarchy{*prepared.base, local.refinements}.finest();
    for (std::size_t i = 0; i < all.size(); i += 4)
      mesh.points[static_cast<std::size_t>(all[i])] = {all[i + 1], all[i + 2], all[i + 3]};
    write_whole(path, [&](const std::string& file) { write_gmsh(mesh, file); });
  });
}

}  // namespace

bool take_unloaded_reference(const Scene& scene, Prepared& prepared, const Checkpoint* from,
                             ResultsFolder& folder, const Log& log, Profiler& profiler) {
  if (!scene.reference) return true;
  UnloadedReport report;
  if (from) {
    report = from->reference();
    rebuild(prepared, [&](std::vector<MeshLevel>& levels) { move_reference(levels, from->unloaded()); });
  } else {
    report = search(scene, prepared, log, profiler);
    if (report.found) refuse_unstable(*prepared.problem, report);
  }
  prepared.reference = report;
  if (!report.found) return false;
  if (report.curvature < -least_curvature) {
    prepared.warnings.emplace_back(
        "perhaps the drawn state is not stable under its loads: the last solution of the search for the "
        "unloaded reference has negative curvature");
    log.warn(prepared.warnings.back());
  }
  log.info(
      fmt::format("unloaded reference {}: {} iterations, {} Krylov iterations, {:.1e} mm from the drawn "
                  "positions, {:.3g} mm between both, in {}",
                  from ? "of the checkpoint" : "found", report.iterations, report.krylov_iterations,
                  report.distance, report.way, duration(report.seconds)));
  folder.claim({unloaded_file});
  write_unloaded(prepared, folder.path() + "/" + unloaded_file);
  return true;
}

MarchReport march_without(const UnloadedReport& r) {
  MarchReport report;
  report.signal = r.signal;
  report.reason =
      r.signal
          ? describe(Outcome::interrupted)
          : fmt::format("no unloaded reference was found: {} ({} iterations, the last distance {:.2g} mm)",
                        r.reason, r.iterations, r.distance);
  return report;
}

std::string remedy_of(const UnloadedReport& r) {
  if (r.signal) return "";
  return "a sheet that folds, or a wall that its pressure has blown up, has no unloaded shape. Lower the "
         "pressures under `reference`, take stiffer tissue or a thicker wall, draw thin detached sheets "
         "flatter, or let `max_iterations` of `reference` be larger if the distances were still falling.";
}

}  // namespace bulbus::inline app
