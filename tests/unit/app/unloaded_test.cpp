#include <gtest/gtest.h>

#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

/// A quarter of a ball, drawn at 15 mmHg, with a rigid cap, a bar and a refined mesh if wished.
const std::string drawn = R"yaml(title: drawn under pressure
mesh: {shell: {inner: 10, outer: 11, n: 4, layers: 2, part: octant}}
regions:
  shell: {c10: 80 kPa}
liquids:
  inside: {surface: inner}
symmetry: [x, y, z]
reference:
  loaded: {inside: 15 mmHg}
steps:
  - name: inflate
    pressures: {inside: 15 mmHg}
  - name: inject
    increments: 2
    enclose: [inside]
    add: {inside: 50 uL}
probes:
  - {name: pressure, kind: pressure, liquid: inside, unit: mmHg}
  - {name: volume, kind: volume, liquid: inside, unit: mL}
  - {name: growth, kind: displacement, set: outer, statistic: max}
solver:
  linear: {method: direct}
  newton: {force: 1e-9, volume: 1e-9}
output: {vtk: false, checkpoint: 1}
)yaml";

TEST(UnloadedRun, BeginsAtTheDrawnPlaces) {
  const Ran r = run_scene(drawn);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto reference = r.summary()["reference"];
  EXPECT_EQ(reference["found"], true);
  EXPECT_LE(reference["distance_mm"], 1e-6);
  EXPECT_LE(reference["first_step_distance_mm"], 1e-6);
  EXPECT_GT(reference["largest_displacement_mm"], .05);
  EXPECT_LE(reference["iterations"], 12);
  EXPECT_NE(r.text("run.log").find("unloaded reference found"), std::string::npos);
  EXPECT_NE(r.text("resolved.yaml").find("reference:"), std::string::npos);
}

/// The mesh of the folder, loaded without `reference`, does what the run did.
TEST(UnloadedRun, LeavesAMeshThatScenesCanRead) {
  const Ran r = run_scene(drawn);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto file = std::filesystem::temp_directory_path() / "bulbus_unloaded_again.msh";
  std::filesystem::copy_file(r.folder / "out/unloaded.msh", file,
                             std::filesystem::copy_options::overwrite_existing);
  const auto wanted = r.summary();
  const std::string shell = "mesh: {shell: {inner: 10, outer: 11, n: 4, layers: 2, part: octant}}";
  std::string again = replaced(drawn, shell, "mesh: {file: " + file.string() + "}");
  again = replaced(again, "reference:\n  loaded: {inside: 15 mmHg}\n", "");
  const Ran loaded = run_scene(again);
  ASSERT_EQ(loaded.status, 0) << loaded.err;
  for (const auto& [name, value] : not_empty(wanted["probes"]).items())
    EXPECT_NEAR(loaded.summary()["probes"][name], value, 1e-7 * std::abs(value.get<double>())) << name;
}

TEST(UnloadedRun, RefinedMeshesComeBackToTheirCurvedSurfaces) {
  const Ran r = run_scene(replaced(drawn, "method: direct", "method: iterative"), {"mesh.refine=1"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_LE(r.summary()["reference"]["first_step_distance_mm"], 1e-6);
  EXPECT_EQ(read_gmsh((r.folder / "out/unloaded.msh").string()).hexes.size(), r.summary()["hexahedra"]);
}

TEST(UnloadedRun, LoadsOnSurfacesAndPrescribedDisplacementsCount) {
  std::string scene = replaced(drawn, "  loaded: {inside: 15 mmHg}\n",
                               "  loaded: {inside: 15 mmHg}\n"
                               "  loads: [{surface: outer, pressure: 0.5 kPa}]\n"
                               "  displace: [{set: zmin, radial: 0.1}]\n");
  scene = replaced(scene, "    pressures: {inside: 15 mmHg}\n  - name: inject\n",
                   "    pressures: {inside: 15 mmHg}\n"
                   "    loads: [{surface: outer, pressure: 0.5 kPa}]\n"
                   "    displace: [{set: zmin, radial: 0.1}]\n  - name: inject\n");
  const Ran r = run_scene(scene);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_LE(r.summary()["reference"]["first_step_distance_mm"], 1e-6);
}

/// A rigid lens in its zonules: the lens keeps its shape, the zonules their tension.
TEST(UnloadedRun, RigidRegionsAndBarsAreUnloadedToo) {
  const Ran r = run_scene(R"yaml(
mesh: {eye: {n: 4}}
materials: physiological
regions:
  lens: {rigid: true}
bars:
  zonules: {E: 100, area: 1e-3}
liquids:
  vitreous: {surface: cavity}
symmetry: [x]
fix: [{set: nerve_end}]
reference: {loaded: {vitreous: 15 mmHg}}
steps:
  - pressures: {vitreous: 15 mmHg}
probes:
  - {name: tension, kind: bar_force, region: zonules, statistic: max, unit: mN}
  - {name: way, kind: displacement, set: lens, statistic: max}
solver:
  linear: {method: direct}
output: {vtk: false}
)yaml");
  ASSERT_EQ(r.status, 0) << r.err;
  const auto s = r.summary();
  EXPECT_LE(s["reference"]["first_step_distance_mm"], 1e-6);
  EXPECT_GT(s["probes"]["way"], 1e-3);
  EXPECT_GT(s["probes"]["tension"], 0);
}

TEST(UnloadedRun, GoesOnFromACheckpointWithoutAnotherSearch) {
  const Ran whole = run_scene(drawn);
  ASSERT_EQ(whole.status, 0) << whole.err;
  const auto wanted = whole.summary();
  const std::string inject =
      "  - name: inject\n    increments: 2\n    enclose: [inside]\n    add: {inside: 50 uL}\n";
  const Ran first =
      call("run", fresh_folder("bulbus_unloaded_left"), "scene.yaml", replaced(drawn, inject, ""), {});
  ASSERT_EQ(first.status, 0) << first.err;
  std::ofstream(first.folder / "scene.yaml") << drawn;
  std::ostringstream out, err;
  const int status =
      command_line({"run", first.folder / "scene.yaml", "-o", first.folder / "out", "--restart"},
                   Comm(MPI_COMM_SELF), out, err);
  ASSERT_EQ(status, 0) << err.str();
  const auto found = first.summary();
  EXPECT_EQ(found["totals"], wanted["totals"]);
  EXPECT_EQ(found["reference"]["iterations"], wanted["reference"]["iterations"]);
  EXPECT_EQ(found["reference"]["first_step_distance_mm"], wanted["reference"]["first_step_distance_mm"]);
  for (const auto& [name, value] : not_empty(wanted["probes"]).items())
    EXPECT_NEAR(found["probes"][name], value, 1e-10 * std::abs(value.get<double>())) << name;
  EXPECT_NE(first.text("run.log").find("unloaded reference of the checkpoint"), std::string::npos);
  EXPECT_TRUE(first.wrote("unloaded.msh"));
}

/// Drawn far beyond the largest pressure that a ball of this rubber bears.
TEST(UnloadedRun, ABalloonThatNoPressureHoldsStopsClearly) {
  std::string scene = drawn;
  for (int i = 0; i < 2; ++i) scene = replaced(scene, "{inside: 15 mmHg}", "{inside: 90 mmHg}");
  const Ran r = run_scene(scene, {"regions.shell.c10=20 kPa"});
  ASSERT_EQ(r.status, 1) << r.err;
  const auto s = r.summary();
  EXPECT_EQ(s["converged"], false);
  EXPECT_EQ(s["reference"]["found"], false);
  EXPECT_NE(s["reason"].get<std::string>().find("no unloaded reference was found"), std::string::npos)
      << s["reason"];
  EXPECT_NE(s["diagnosis"].get<std::string>().find("Lower the pressures"), std::string::npos);
  EXPECT_TRUE(s["probes"]["pressure"].is_null());
}

struct Slip {
  std::string from, to, message;
};

TEST(UnloadedRun, WhatWouldBeAmbiguousIsRefused) {
  for (const Slip& slip : std::vector<Slip>{
           {"loaded: {inside: 15 mmHg}", "loaded: {outside: 15 mmHg}",
            "scene.yaml:9: reference.loaded.outside: there is no liquid 'outside'"},
           {"  loaded: {inside: 15 mmHg}", "  tolerance: 1e-5", "the mesh is drawn under no load"},
           {"loaded: {inside: 15 mmHg}", "loaded: {inside: 15*q}", "scene.yaml:9: reference.loaded.inside: "},
           {"loaded: {inside: 15 mmHg}", "loaded: {inside: 15 mmHg}\n  displace: [{set: nowhere, x: 0}]",
            "scene.yaml:10: reference.displace.0.set: "},
           {"    enclose: [inside]", "    enclose: [inside]\n    displace: [{set: zmin, x: 0}]",
            "the displacement counts from the reference"},
           {"    enclose: [inside]",
            "    enclose: [inside]\n    displace: [{set: zmin, affine: [1, 0, 0, 0, 1, 0, 0, 0, 1]}]",
            "the displacement counts from the reference"}}) {
    const Ran r = run_scene(replaced(drawn, slip.from, slip.to), {}, "check");
    EXPECT_EQ(r.status, 2) << slip.to;
    EXPECT_NE(r.err.find(slip.message), std::string::npos) << r.err;
  }
}

}  // namespace
