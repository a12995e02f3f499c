#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/memory/sizes.hpp"
#include "app/prepare.hpp"
#include "app/study/study_design.hpp"

namespace bulbus::inline app {

int check_study(const Study& study, const Comm& comm, Log::Screen screen) {
  const auto runs = plan(study);
  figures_of(study, runs);
  const Log log("", comm, screen);
  log.info(size_text(study));
  for (const StudyRun& run : runs)
    of_run(study, run, [&] {
      const Prepared prepared = prepare(run.scene, comm);
      const long long unknowns = sizes_of(*prepared.problem).unknowns();
      for (const std::string& warning : prepared.warnings) log.warn(run.name + ": " + warning);
      log.info(fmt::format("{}: {}; {} unknowns", run.name, words_of(study, run.levels), unknowns));
    });
  return 0;
}

}  // namespace bulbus::inline app
