// What the mesh is worth: the half eye at 15 mmHg and 1 mm of indentation on three meshes, each hexahedron
// split in eight from one to the next, by `bulbus run`; the observed order and the extrapolated figures.
//
//     bench_mesh_convergence [-n CELLS] [--refine TIMES] [-o FILE]
#include <cmath>

#include "app/study/extrapolation.hpp"
#include "benchmarks/scene_run.hpp"

using namespace bulbus::bench;

namespace {

// Held along the axis the indented ring is a stable place to be.
SceneRun half_eye_run(int n, int refine) {
  return {scene_file("half_eye"),
          {"mesh.eye.n=" + std::to_string(n), "mesh.refine=" + std::to_string(refine),
           "steps.1.displace.0.radial=-1", "steps.1.displace.0.z=0", "steps.1.increments=2"},
          3600};
}

std::vector<json> extrapolated(const std::vector<json>& runs) {
  std::vector<json> rows;
  std::vector<double> h;
  for (std::size_t level = 0; level < runs.size(); ++level) h.push_back(std::pow(.5, level));
  for (const auto& [name, unit] : runs.back()["units"].items()) {
    std::vector<double> v;
    for (const json& run : runs)
      if (run["probes"][name].is_number()) v.push_back(run["probes"][name]);
    if (v.size() < h.size() || v.front() == v.back()) continue;
    const auto e = bulbus::extrapolate(h, v);
    json row{{"probe", name},
             {"unit", unit},
             {"extrapolated", e.value},
             {"order", e.observed ? json(e.order) : json("none: 2 assumed")}};
    for (std::size_t level = 0; level < v.size(); ++level) row["level_" + std::to_string(level)] = v[level];
    row["error_percent"] = e.value != 0 ? 100 * std::abs(v.back() / e.value - 1) : 0;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  const Options o = parse(argc, argv, {8}, {4}, 1);
  const int levels = o.smoke ? 2 : std::max(o.refine, 2) + 1;
  json report = new_report("mesh_convergence", o);
  report["notes"] =
      "half_eye.yaml at 15 mmHg, then 1 mm of indentation with the ring held along the axis and the liquid "
      "enclosed; order and "
      "extrapolation of the three finest meshes; error of the finest one";
  std::vector<json> runs;
  for (int level = 0; level < levels; ++level) {
    runs.push_back(run_scene(half_eye_run(o.sizes[0], level)));
    runs.back().update({{"n", o.sizes[0]}, {"refine", level}});
    if (!runs.back()["converged"]) break;
  }
  report["rows"] = runs;
  if (runs.back()["converged"]) report["probes"] = extrapolated(runs);
  finish(report,
         {"n", "refine", "hexahedra", "unknowns", "cpu_s", "peak_mb", "newton_iterations",
          "krylov_iterations", "converged", "reason"},
         o);
  print_table(report["probes"],
              {"probe", "unit", "level_0", "level_1", "level_2", "extrapolated", "order", "error_percent"});
  return !runs.back()["converged"];
}
