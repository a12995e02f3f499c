// A whole scene as a user runs it, `bulbus run`, by the iterative and by the direct solver: time, memory, and
// whether both say the same. Each runs as a process of its own, one after the other, on one thread.
//
//     bench_operation [--scene FILE] [--set KEY=VALUE ...] [--n CELLS] [--json FILE] [--timeout SECONDS]
#include <filesystem>
#include <stdexcept>

#include "benchmarks/scene_run.hpp"
#include "core/io/json_file.hpp"

using namespace bulbus::bench;

namespace {

SceneRun given_in(Options& o) {
  SceneRun given{scene_file("encircling")};
  for (std::size_t i = 0; i < o.rest.size(); i += 2) {
    const std::string key = o.rest[i], value = i + 1 < o.rest.size() ? o.rest[i + 1] : "";
    if (key == "--scene")
      given.scene = value;
    else if (key == "--set")
      given.set.push_back(value);
    else if (key == "--timeout")
      given.timeout = std::stoi(value);
    else if (key == "--json")
      o.out = value;
    else if (key == "--n")
      o.sizes = {std::stoi(value)};
    else
      throw std::invalid_argument("unknown option " + key);
  }
  if (!o.sizes.empty()) given.set.push_back("mesh.eye.n=" + std::to_string(o.sizes[0]));
  return given;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Options o = parse(argc, argv, {}, {}, 1);
  SceneRun given = given_in(o);
  if (o.smoke) given.scene = scene_file("suture");
  json report = new_report("operation", o);
  report["parameters"].update({{"scene", std::filesystem::path(given.scene).filename()},
                               {"set", given.set},
                               {"timeout_s", given.timeout}});
  report["notes"] =
      "`bulbus run` of the scene as a process of its own; minutes are processor time as the system counts "
      "it, peak MB the "
      "largest resident set; the seconds by part in the record are wall time; probes differ relative to the "
      "largest "
      "magnitude they had in either run";
  for (const char* method : {"iterative", "direct"}) {
    SceneRun one = given;
    one.set.push_back(std::string("solver.linear.method=") + method);
    report["rows"].push_back(run_scene(one));
    report["rows"].back()["method"] = method;
    if (!o.out.empty()) bulbus::write_json(o.out, report);  // what is measured so far
  }
  report["probes"] = compared_probes(report["rows"][0], "iterative", report["rows"][1], "direct");
  finish(report,
         {"method", "hexahedra", "unknowns", "cpu_s", "wall_s", "peak_mb", "increments", "newton_iterations",
          "krylov_iterations", "cuts", "converged", "reason"},
         o);
  print_table(report["probes"], {"probe", "unit", "iterative", "direct", "relative"});
  const bool agree = !report["probes"].empty() && report["probes"][0].value("relative", 0.) < 1e-3;
  return report["probes"].empty() || (o.smoke && !agree);
}
