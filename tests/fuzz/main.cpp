// Faulty scenes, studies, meshes, bodies and checkpoints, thousands in a minute: each has to be accepted or
// refused with place and remedy.
//
//     fuzz --seed 7 --mutants 100000 --keep found
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "core/base/parallel.hpp"
#include "tests/fuzz/campaign.hpp"

namespace {

using namespace bulbus::fuzz;

int work_for_another(const Options& options, int argc, char** argv) {
  const bulbus::Session session(argc, argv);
  const int file = open(options.progress.c_str(), O_RDWR);
  auto* progress =
      static_cast<Progress*>(mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  if (progress == MAP_FAILED) return 2;
  work(options, *progress);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Tries faulty inputs on the program", "fuzz"};
  app.add_option("--seed", options.seed, "another seed, other mutants");
  app.add_option("--first", options.first, "number of the first mutant");
  app.add_option("--mutants", options.mutants, "number behind the last mutant");
  app.add_option("--seconds", options.seconds, "end after this time; 0: when all are tried");
  app.add_option("--kind", options.kind, "scene, study, mesh, body, checkpoint or foreign")
      ->check(CLI::IsMember({"all", "scene", "study", "mesh", "body", "checkpoint", "foreign"}));
  app.add_option("--keep", options.keep, "folder that receives failing mutants");
  app.add_option("--accepted", options.accepted, "folder that receives accepted scenes");
  app.add_option("--plant", options.plant,
                 "a fault to be found: exception, crash, stack, hang, memory, silent or no_remedy");
  app.add_flag("--messages", options.messages, "print every refusal");
  app.add_flag("--show", options.show, "print the first mutant instead of trying it");
  app.add_option("--progress", options.progress)->group("");
  CLI11_PARSE(app, argc, argv);
  if (!options.progress.empty()) return work_for_another(options, argc, argv);
  return campaign(options, {argv + 1, argv + argc}) == 0 ? 0 : 1;
}
