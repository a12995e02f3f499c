#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/memory_forecast.hpp"
#include "app/prepare.hpp"
#include "app/sizes.hpp"
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
  print(log, lines_of(prepared.quality));
  print(log, lines_of(sizes));
  print(log, liquid_lines(problem));
  for (const std::string& warning : prepared.warnings) log.warn(warning);
  log.info(fmt::format("memory to expect with the {} solver, over all ranks (MB):",
                       scene.solver.linear.method));
  const auto parts = forecast_memory(prepared, scene);
  for (const auto& [part, bytes] : parts) log.info(fmt::format("  {:<28} {:>10.1f}", part, 1e-6 * bytes));
  log.info(fmt::format("  {:<28} {:>10.1f}", "together", 1e-6 * sum_of(parts)));
  comm.together([&] { refuse_what_cannot_fit(parts, scene.solver.linear); });
  return 0;
}

}  // namespace bulbus
