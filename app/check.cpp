#include "app/commands.hpp"
#include "app/memory/memory_forecast.hpp"
#include "app/memory/mesh_lines.hpp"
#include "app/memory/sizes.hpp"
#include "app/prepare.hpp"
#include "core/io/log.hpp"

namespace bulbus::inline app {

int check(const Scene& scene, const Comm& comm, Log::Screen screen) {
  const Prepared prepared = prepare(scene, comm);
  const Problem& problem = *prepared.problem;
  const Sizes sizes = sizes_of(problem);
  const Log log("", comm, screen);
  log.info(prepared.notes);
  log.info(lines_of(prepared.quality));
  log.info(surface_lines(problem.mesh()));
  log.info(set_lines(problem.mesh()));
  log.info(poor_cell_lines(problem.mesh()));
  log.info(lines_of(sizes));
  log.info(liquid_lines(problem));
  for (const std::string& warning : prepared.warnings) log.warn(warning);
  const MemoryForecast memory = forecast_memory(prepared, scene);
  log.info(lines_of(memory, scene.solver.linear));
  comm.together([&] { refuse_what_cannot_fit(memory, scene.solver.linear); });
  return 0;
}

}  // namespace bulbus::inline app
