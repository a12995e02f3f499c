#include "app/records/summary.hpp"

#include <mpi.h>

#include <nlohmann/json.hpp>

#include "app/records/contact_summary.hpp"
#include "app/version.hpp"
#include "core/base/memory.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

// Largest and sum over the ranks; every rank keeps count of the same parts.
json over_ranks(const Comm& comm, double value) {
  return {{"largest_rank", comm.max(value)}, {"all_ranks", comm.sum(value)}};
}

json memory_of(const Problem& problem, const Profiler& profiler) {
  const Comm& comm = problem.comm();
  json parts;
  for (const auto& [part, bytes] : profiler.memory.peaks()) parts[part] = over_ranks(comm, bytes / megabyte);
  return {{"parts", parts}, {"process_peak", over_ranks(comm, peak_resident_bytes() / megabyte)}};
}

json seconds_of(const Comm& comm, const Profiler& profiler, double total) {
  json seconds;
  for (const auto& [part, s] : profiler.clock.seconds()) seconds[part] = comm.max(s);
  seconds["total"] = comm.max(total);
  return seconds;
}

json unknowns_of(const Sizes& s) {
  return {{"displacement", s.displacement},
          {"element_pressure", s.element_pressure},
          {"liquid_pressure", s.liquid_pressure},
          {"rigid", s.rigid},
          {"total", s.unknowns()}};
}

json steps_of(const std::vector<StepRecord>& steps) {
  json list = json::array();
  for (const StepRecord& s : steps)
    list.push_back({{"name", s.name},
                    {"increments", s.increments},
                    {"newton_iterations", s.newton_iterations},
                    {"krylov_iterations", s.krylov_iterations},
                    {"cuts", s.cuts},
                    {"seconds", s.seconds}});
  return list;
}

json totals_of(const MarchReport& m) {
  return {{"increments", m.increments},
          {"newton_iterations", m.newton_iterations},
          {"krylov_iterations", m.krylov_iterations},
          {"cuts", m.cuts}};
}

json factor_of(const FactorReport& f, double worst_reduction) {
  return {{"matrix_entries", f.matrix_entries},
          {"factor_entries", f.factor_entries},
          {"estimated_mb", f.estimated_mb},
          {"memory_mb", f.memory_mb},
          {"flops", f.flops},
          {"ordering", f.ordering},
          {"largest_residual", worst_reduction}};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> versions() {
  char mpi[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(mpi, &length);
  std::string library(mpi, length);
#ifdef NDEBUG
  const char* build = "optimised, without assertions";
#else
  const char* build = "with assertions";
#endif
  return {{"bulbus", version},
          {"compiler", "C++ " __VERSION__},
          {"build", build},
          {"mpi", library.substr(0, library.find_first_of(",\n"))}};
}

nlohmann::json summary_of(const std::string& title, const Prepared& prepared, const Recorder& recorder,
                          const MarchReport& march, const Profiler& profiler, double seconds) {
  const Problem& problem = *prepared.problem;
  const Sizes sizes = sizes_of(problem);
  json s{{"title", title},
         {"converged", march.converged},
         {"reason", march.converged ? "all steps done" : march.reason},
         {"hexahedra", sizes.hexahedra},
         {"nodes", sizes.nodes},
         {"bars", sizes.bars},
         {"unknowns", unknowns_of(sizes)},
         {"steps", steps_of(recorder.steps())},
         {"totals", totals_of(march)},
         {"seconds", seconds_of(problem.comm(), profiler, seconds)},
         {"memory_mb", memory_of(problem, profiler)},
         {"ranks", problem.comm().size()}};
  s["probes"] = s["units"] = s["versions"] = json::object();
  for (std::size_t i = 0; i < recorder.probes().size(); ++i) {
    const auto& value = recorder.values()[i];
    s["probes"][recorder.probes().name(i)] = value ? json(*value) : json();
    s["units"][recorder.probes().name(i)] = recorder.probes().unit(i);
  }
  s["contacts"] = contacts_summary(*prepared.interactions, recorder.contacts());
  s["rigid_bodies"] = bodies_summary(problem, *prepared.interactions, recorder.contacts());
  if (recorder.negative_pivots() >= 0) {
    s["negative_pivots"] = recorder.negative_pivots();
    s["negative_pivots_if_stable"] = stable_pivots(problem);
  }
  s["direct_solves"] = recorder.direct_solves();
  s["unstable_increments"] = recorder.unstable_increments();
  if (recorder.factor()) s["factor"] = factor_of(*recorder.factor(), recorder.worst_reduction());
  for (const auto& [name, v] : versions()) s["versions"][name] = v;
  s["warnings"] = prepared.warnings;
  s["input_files"] = hashes_of(prepared.inputs);
  return s;
}

}  // namespace bulbus::inline app
