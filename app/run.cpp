#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/memory/memory_forecast.hpp"
#include "app/memory/sizes.hpp"
#include "app/prepare.hpp"
#include "app/records/alternating_pressures.hpp"
#include "app/records/closed_part.hpp"
#include "app/records/contact_summary.hpp"
#include "app/records/dumping_solver.hpp"
#include "app/records/folder.hpp"
#include "app/records/log_columns.hpp"
#include "app/records/point_supports.hpp"
#include "app/records/recorder.hpp"
#include "app/records/summary.hpp"
#include "app/report/report.hpp"
#include "app/unloaded.hpp"
#include "contact/crossings.hpp"
#include "contact/entered_vertices.hpp"
#include "core/base/interrupt.hpp"
#include "core/io/disk_file.hpp"
#include "core/io/json_file.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"
#include "core/solve/direct/make_factorisation.hpp"
#include "precond/make_preconditioner.hpp"

namespace bulbus::inline app {
namespace {

// Which algebraic multigrid it is; Bulbus's own says no more than its name.
std::string amg_of(Displacement by) {
  if (by == Displacement::boomeramg) return " (hypre's BoomerAMG, component by component)";
  if (by == Displacement::boomeramg_nodal) return " (hypre's BoomerAMG, node by node with the rotations)";
  if (by == Displacement::scalar_amg) return " (hypre's BoomerAMG on xx, yy and zz)";
  if (by == Displacement::hybrid)
    return " (hypre's BoomerAMG on xx, yy and zz between smoothers, with rigid-body modes)";
  return "";
}

std::string name_of_direct(const LinearSettings& l) {
  const std::string ordering =
      l.ordering == Ordering::scotch ? "" : fmt::format(", ordering {}", word_of(l.ordering));
  return fmt::format("direct ({}{}{})", name_of(l.direct), ordering,
                     l.refinement == Refinement::gmres ? ", refined by GMRES" : "");
}

std::string name_of_solver(const LinearSettings& l, const Problem& problem) {
  const std::string liquids = l.formulation == Formulation::eliminated ? ", liquid pressures eliminated" : "";
  if (l.method == Method::direct) return name_of_direct(l) + liquids;
  const std::string why = l.displacement != Displacement::automatic ? ""
                          : problem.coarser()                       ? " (the mesh is refined)"
                                                                    : " (the mesh is not refined)";
  const Displacement by = l.displacement_on(problem.coarser());
  return fmt::format("GMRES({}), displacement block by {}{}{}, operator {}, gamma {:g}{}", l.restart,
                     word_of(by), amg_of(by), why, word_of(l.op), l.gamma, liquids);
}

std::vector<std::string> lines_of_levels(const Problem& problem) {
  std::vector<std::string> lines;
  for (const Problem* p = problem.coarser(); p; p = p->coarser())
    lines.push_back(
        fmt::format("coarser level: {} hexahedra, {} nodes", p->mesh().all_hexes, p->mesh().all_nodes));
  return lines;
}

std::string line_of(const MemoryForecast& forecast) {
  std::string line = fmt::format("memory to expect: {:.0f} MB over all ranks", 1e-6 * forecast.together());
  if (forecast.fallback > 0)
    line += fmt::format(", and {:.0f} more if MUMPS takes over a system", 1e-6 * forecast.fallback);
  return line;
}

void write_header(const Log& log, const Scene& scene, const std::string& scene_path, const Prepared& prepared,
                  const MemoryForecast& memory) {
  const Comm& comm = prepared.problem->comm();
  std::string made_of;
  for (const auto& [name, v] : versions()) made_of += (made_of.empty() ? "" : ", ") + name + " " + v;
  log.info(made_of);
  log.info(fmt::format("{}{} on {} rank{}", scene_path, scene.title.empty() ? "" : ": " + scene.title,
                       comm.size(), comm.size() == 1 ? "" : "s"));
  log.info(prepared.notes);
  log.info(lines_of(prepared.quality));
  log.info(lines_of(sizes_of(*prepared.problem)));
  log.info(liquid_lines(*prepared.problem));
  log.info("linear solver: " + name_of_solver(scene.solver.linear, *prepared.problem));
  log.info(lines_of_levels(*prepared.problem));
  log.info(line_of(memory));
  for (const std::string& warning : prepared.warnings) log.warn(warning);
  log.info("");
  log.info(legend_of(newton_table()));
}

// Where seconds and bytes of this rank went.
void write_details(const Log& log, const Profiler& profiler) {
  for (const auto& [part, seconds] : profiler.clock.seconds())
    log.detail(fmt::format("  {:<28} {}", part, duration(seconds)));
  for (const auto& [part, bytes] : profiler.memory.peaks())
    log.detail(fmt::format("  {:<28} {:.1f} MB", part, bytes / megabyte));
}

// The regions that `materials` stands for come out one by one.
Scene with_materials_of(const Problem& problem, Scene scene) {
  scene.model = problem.model();
  return scene;
}

nlohmann::json json_of(const MemoryForecast& forecast) {
  nlohmann::json mb{{"together", 1e-6 * forecast.together()}, {"fallback", 1e-6 * forecast.fallback}};
  for (const auto& [part, bytes] : forecast.parts) mb[part] = 1e-6 * bytes;
  return mb;
}

void write_end(const Log& log, const Model& model, const Recorder& recorder, const MarchReport& march,
               const std::string& diagnosis, const std::string& folder, double seconds, bool has_begun) {
  log.info("");
  for (std::size_t i = 0; i < model.probes.size(); ++i)
    if (const auto& value = recorder.values()[i])
      if (const auto part = closed_part(model.probes[i], *value))
        log.info(fmt::format("{}: {:.2f} of its nodes are closer than {:g} mm", model.probes[i].name, *part,
                             model.probes[i].tolerance));
  if (march.signal && !has_begun)
    log.warn(
        fmt::format("interrupted by {} before the unloaded reference was found: 'bulbus run' starts anew",
                    name_of_interrupt(march.signal)));
  else if (march.signal)
    log.warn(
        fmt::format("interrupted by {} after increment {}: 'bulbus run' with --restart goes on from there",
                    name_of_interrupt(march.signal), march.increments));
  else if (!march.converged)
    log.error("not converged: " + march.reason);
  if (!diagnosis.empty()) log.error("diagnosis: " + diagnosis);
  log.info(fmt::format("{} increments, {} Newton and {} Krylov iterations, {} cuts in {}", march.increments,
                       march.newton_iterations, march.krylov_iterations, march.cuts, duration(seconds)));
  if (recorder.direct_solves() > 0)
    log.info(fmt::format("{} linear system{} solved by MUMPS, where GMRES did not converge",
                         recorder.direct_solves(), recorder.direct_solves() == 1 ? " was" : "s were"));
  log.info("results in " + folder);
}

std::string folder_of(const std::string& file) {
  const auto folder = std::filesystem::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

// A run is none the worse for a page that cannot be made.
void write_report_of(ResultsFolder& folder, const Log& log, const Comm& comm) {
  folder.claim({report_file});
  if (comm.rank() != 0) return;
  try {
    write_whole(folder.path() + "/" + report_file, run_report(folder.path()));
    log.info("open " + folder.path() + "/" + report_file + " in a browser");
  } catch (const std::runtime_error& fault) {
    log.warn(std::string("there is no ") + report_file + ": " + fault.what());
  }
}

// Where the log itself cannot be written, nothing can be done.
void note_in_log(const ResultsFolder& folder, const std::string& fault) {
  const std::string log = folder.path() + "/" + log_file;
  if (!std::filesystem::exists(log)) return;
  try {
    DiskFile(log, DiskFile::Start::end).write("error: " + fault + "\n");
  } catch (const std::runtime_error&) {
  }
}

// What the last state tells. Collective.
std::vector<std::string> warnings_of(const Prepared& prepared, const Recorder& recorder, const State& state,
                                     Profiler& profiler) {
  const auto scope = profiler.clock.measure("checks of the last state");
  const auto& contacts = recorder.contacts();
  std::vector<std::string> all;
  if (const auto pressures = alternating_pressures(*prepared.problem, state))
    all.push_back(sentence(*pressures));
  for (const auto& told :
       {deep_contacts(*prepared.interactions, contacts), missed_tolerances(*prepared.interactions, contacts),
        lost_tangents(*prepared.interactions, prepared.problem->model()),
        point_supports(*prepared.problem, state), turned_radials(*prepared.problem, state),
        soft_contacts(*prepared.problem, *prepared.interactions, contacts, state),
        entered_vertices(*prepared.problem, *prepared.interactions, state),
        crossed_surfaces(*prepared.problem, *prepared.interactions, state)})
    std::ranges::copy(told, std::back_inserter(all));
  return all;
}

int run_into(ResultsFolder& folder, const Scene& scene, const std::string& scene_path, const Comm& comm,
             Log::Screen screen, const std::string& checkpoint) {
  const double start = Clock::now();
  Profiler profiler;
  Prepared prepared;
  MemoryForecast memory;
  {
    const auto scope = profiler.clock.measure("mesh and problem");
    prepared = prepare(scene, comm);
    memory = forecast_memory(prepared, scene);
    comm.together([&] { refuse_what_cannot_fit(memory, scene.solver.linear); });
  }
  std::optional<Checkpoint> from;
  if (!checkpoint.empty()) from.emplace(checkpoint, scene, prepared);
  if (from)
    folder.go_on(folder_of(checkpoint), from->place().report.increments);
  else
    folder.begin();
  if (comm.any(comm.rank() == 0 && !folder.held()))
    prepared.warnings.push_back(
        folder.path() + ": its file system has no locks: nothing keeps a second run out of this folder");
  const auto path_of = [&](const char* file) { return folder.path() + "/" + file; };
  folder.claim({resolved_file, log_file, summary_file});
  write_together(comm, [&] {
    if (comm.rank() == 0)
      write_whole(path_of(resolved_file), resolved_yaml(with_materials_of(*prepared.problem, scene)));
  });
  const FileStart start_of_records = from ? FileStart::continued : FileStart::anew;
  const Log log(path_of(log_file), comm, screen, start_of_records);
  write_header(log, scene, scene_path, prepared, memory);

  const InterruptsHeeded heeded;
  const bool may_begin =
      take_unloaded_reference(scene, prepared, from ? &*from : nullptr, folder, log, profiler);
  Problem& problem = *prepared.problem;
  Recorder recorder(prepared, scene, folder, log, profiler, start_of_records);
  const auto conclude = [&](const MarchReport& report, const std::string& diagnosis) {
    const double seconds = Clock::now() - start;
    auto summary = summary_of(scene.title, prepared, recorder, report, profiler, seconds);
    summary["memory_mb"]["forecast"] = json_of(memory);
    if (!diagnosis.empty()) summary["diagnosis"] = diagnosis;
    write_together(comm, [&] {
      if (comm.rank() == 0) write_json(path_of(summary_file), summary);
    });
    write_details(log, profiler);
    write_end(log, scene.model, recorder, report, diagnosis, folder.path(), seconds, may_begin);
    if (scene.output.report && !report.signal) write_report_of(folder, log, comm);
    write_together(comm, [&] { log.require_written(); });
    if (report.signal) return 128 + report.signal;
    return report.converged ? 0 : 1;
  };
  if (!may_begin) return conclude(march_without(*prepared.reference), remedy_of(*prepared.reference));

  const LinearSettings& linear = scene.solver.linear;
  auto solver = make_solver(linear, profiler);
  if (!linear.dump.empty())
    solver = make_dumping_solver(
        std::move(solver), linear.dump, folder, [&] { return recorder.increments() + 1; }, comm);
  solver->watch([&](const SolveProgress& progress) { recorder.solve_lasts(progress); });
  auto [place, step_start, state] = from ? recorder.resume(*from) : Resumed{.state = problem.initial_state()};
  if (prepared.reference && place.report.increments == 0) place.expected = prepared.reference->loaded;
  const MarchReport report = march(problem, *solver, state, scene.solver, profiler, recorder, place);

  recorder.finish(state);
  for (const std::string& warning : warnings_of(prepared, recorder, state, profiler)) {
    prepared.warnings.push_back(warning);
    log.warn(warning);
  }
  std::ranges::copy(recorder.snaps(), std::back_inserter(prepared.warnings));
  if (const int unstable = recorder.unstable_increments(); unstable > 0)  // the log has each
    prepared.warnings.push_back(fmt::format(
        "not a stable equilibrium, or perhaps not, at the end of {} of {} increments: the log tells "
        "which, and by how many negative pivots or by negative curvature. The body would leave it "
        "at the least push.",
        unstable, recorder.increments()));
  profiler.memory.set("mesh", problem.mesh().bytes());
  const bool stuck = !report.converged && !report.signal;
  return conclude(report, !stuck ? "" : report.remedy.empty() ? recorder.diagnosis(state) : report.remedy);
}

}  // namespace

int run(const Scene& scene, const std::string& scene_path, const std::string& out_dir, const Comm& comm,
        Log::Screen screen, const std::string& checkpoint) {
  ResultsFolder folder(out_dir, record_names(scene), comm, checkpoint);
  try {
    return run_into(folder, scene, scene_path, comm, screen, checkpoint);
  } catch (const OutputError& e) {
    if (comm.rank() == 0) note_in_log(folder, e.what());
    throw;
  }
}

}  // namespace bulbus::inline app
