// What the parts of a scene cost: the same eye with fewer of them, and with a rigid lens, as a user runs it
// (`bulbus run`).
//
//     bench_features [-n CELLS] [-r REPETITIONS] [-o FILE]
#include <algorithm>
#include <cstdio>

#include "benchmarks/scene_run.hpp"
#include "core/io/json_file.hpp"

using namespace bulbus::bench;

namespace {

struct Variant {
  std::string scene, name;
  std::vector<std::string> set;
};

const std::vector<std::string> rigid_lens{"regions.lens.rigid=true"};
// A rigid lens has no stress to record: the operation's probe looks at the ciliary body instead, in both
// runs.
const std::vector<std::string> other_probe{"probes.lens_mises_99.region=ciliary_body",
                                           "probes.lens_mises_99.name=ciliary_body_mises_99"};
const std::vector<std::string> rigid_lens_other_probe{rigid_lens[0], other_probe[0], other_probe[1]};

const std::vector<Variant> variants{{"half_eye", "half eye", {}},
                                    {"half_eye", "half eye, rigid lens", rigid_lens},
                                    {"encircling", "operation", other_probe},
                                    {"encircling", "operation, rigid lens", rigid_lens_other_probe}};

// The repetition with the median processor time.
json measured(const Variant& v, const Options& o) {
  std::vector<json> runs;
  for (int r = 0; r < o.repetitions; ++r) {
    SceneRun run{scene_file(v.scene), v.set};
    run.set.push_back("mesh.eye.n=" + std::to_string(o.sizes[0]));
    if (o.smoke) run.set.push_back("steps.1.increments=1");
    runs.push_back(run_scene(run));
  }
  std::ranges::sort(runs, {}, [](const json& row) { return row["cpu_s"].get<double>(); });
  json row = runs[runs.size() / 2];
  row["scene"] = v.name;
  row["n"] = o.sizes[0];
  if (!row["converged"]) return row;
  const double newton = row["newton_iterations"], krylov = row["krylov_iterations"];
  for (auto [key, part] : {std::pair{"residual_ms", "residual"},
                           {"linearisation_ms", "linearisation"},
                           {"setup_ms", "preconditioner set-up"}})
    row[key] = 1e3 * row["seconds"].value(part, 0.) / newton;
  row["krylov_ms"] = 1e3 * row["seconds"].value("linear solve", 0.) / krylov;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  const Options o = parse(argc, argv, {14}, {4}, 1);
  json report = new_report("features", o);
  for (const Variant& v : variants) report["parameters"]["set"][v.name] = v.set;
  report["notes"] =
      "`bulbus run` of data/scenes as processes of their own; minutes are processor time, those of parts "
      "wall time per Newton, of "
      "the linear solve per Krylov iteration; probes: how much a rigid lens changes them, relative to the "
      "largest "
      "magnitude they had in either run";
  const std::size_t count = o.smoke ? 2 : variants.size();  // a small eye is too coarse for the operation
  for (std::size_t i = 0; i < count; ++i) {
    report["rows"].push_back(measured(variants[i], o));
    if (i % 2 == 0) continue;
    for (json probe : compared_probes(report["rows"][i - 1], "deformable", report["rows"][i], "rigid")) {
      probe["scene"] = variants[i - 1].name;
      report["probes"].push_back(probe);
    }
    if (!o.out.empty()) bulbus::write_json(o.out, report);  // what is measured so far
  }
  finish(report,
         {"scene", "hexahedra", "unknowns", "cpu_s", "peak_mb", "newton_iterations", "krylov_iterations",
          "residual_ms", "linearisation_ms", "setup_ms", "krylov_ms", "converged", "reason"},
         o);
  print_table(report.value("probes", json::array()),
              {"scene", "probe", "unit", "deformable", "rigid", "relative"});
  return std::ranges::any_of(report["rows"], [](const json& row) { return !row["converged"]; });
}
