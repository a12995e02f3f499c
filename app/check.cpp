#include "app/commands.hpp"
#include "app/memory/memory_forecast.hpp"
#include "app/memory/mesh_lines.hpp"
#include "app/memory/sizes.hpp"
#include "app/prepare.hpp"
#include "core/io/log.hpp"

namespace bulbus {
namespace {

void print(const Log& log, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log.info(line);
}

}  // namespace

int check(const Scene& scene, const Comm& comm) {
  const Prepared prepared = prepare(scene, comm);
  const Problem& problem = *prepared.problem;
  const Sizes sizes = sizes_of(problem);
  const Log log("", comm);
  print(log, prepared.notes);
  print(log, lines_of(prepared.quality));
  print(log, surface_lines(problem.mesh()));
  print(log, set_lines(problem.mesh()));
  print(log, poor_cell_lines(problem.mesh()));
  print(log, lines_of(sizes));
  print(log, liquid_lines(problem));
  for (const std::string& warning : prepared.warnings) log.warn(warning);
  const MemoryForecast memory = forecast_memory(prepared, scene);
  print(log, lines_of(memory, scene.solver.linear));
  comm.together([&] { refuse_what_cannot_fit(memory, scene.solver.linear); });
  return 0;
}

}  // namespace bulbus
