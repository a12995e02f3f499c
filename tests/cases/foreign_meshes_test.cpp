// One model from Gmsh, Abaqus and VTK files, and sets by conditions.
#include "tests/support/foreign_meshes.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

const std::string scene = R"(title: a shell of two layers with liquid in it
mesh: {file: shell.msh}
regions: {"1": {c10: 50 kPa}, "2": {c10: 100 kPa}}
liquids: {filling: {surface: inner}}
symmetry: [x, y, z]
steps:
  - name: inflate
    increments: 2
    pressures: {filling: 5 kPa}
probes:
  - {name: volume, kind: volume, liquid: filling}
  - {name: outside, kind: displacement, set: outer}
  - {name: stress, kind: mises}
)";

const std::string by_conditions =
    "mesh.surfaces={inner: \"X*X + Y*Y + Z*Z < 1.01\", outer: \"X*X + Y*Y + Z*Z > 3.99\"}";

class ForeignMeshes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder("bulbus_foreign_" + std::to_string(getpid()));
    Mesh mesh = generate(ShellShape{.n = 3, .layers = 2});
    for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
      mesh.region[e] = norm(center(mesh, static_cast<int>(e))) < 1.5 ? 0 : 1;
    mesh.region_names = {"1", "2"};
    write_gmsh(mesh, file("shell.msh"));
    mesh = read_gmsh(file("shell.msh"));  // its order of cells
    write("shell.inp", abaqus_text(mesh));
    write("shell.vtu", vtu_text(mesh, {.binary = true, .appended = true, .compressed = true}));
    write("shell.vtk", legacy_vtk_text(mesh, true));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  Ran call_on(const std::string& name, std::vector<std::string> set = {},
              const std::string& command = "run") {
    set.push_back("mesh.file=" + name);
    return call(command, folder_, "s.yaml", scene, set);
  }
  std::string figures(const Ran& run) {
    EXPECT_EQ(run.status, 0) << run.err;
    return run.status == 0 ? run.summary()["probes"].dump() : "";
  }

  std::filesystem::path folder_;
};

TEST_F(ForeignMeshes, GiveIdenticalFigures) {
  const Ran run = call_on("shell.msh");
  const std::string wanted = figures(run);
  ASSERT_GT(probe(run, "volume"), 3.9);
  EXPECT_EQ(figures(call_on("shell.inp")), wanted);
  for (const char* name : {"shell.vtu", "shell.vtk"})
    EXPECT_EQ(figures(call_on(name, {by_conditions})), wanted);
}

TEST_F(ForeignMeshes, AreListedByCheck) {
  testing::internal::CaptureStdout();
  const Ran run = call_on("shell.inp", {"mesh.sets={middle: \"abs(X - Y) < 1e-6\"}"}, "check");
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"skipped in the mesh file: *ELASTIC, *END STEP, *MATERIAL, *STATIC, *STEP",
                           "surface ", "area mm2", "inner ", "node set ", "middle ", "ALL "})
    EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
}

// What joins the parts of a body is told as a warning, the rest as a note.
TEST_F(ForeignMeshes, ConstraintsThatAreNotReadAreWarnedOf) {
  const auto text = [&](const std::string& name) {
    std::ifstream in(file(name));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  write("tied.inp", text("shell.inp") +
                        "*TIE, NAME=t\nouter, inner\n*EQUATION\n2\n1,1,1.,2,1,-1.\n*EQUATION\n2\n"
                        "1,2,1.,2,2,-1.\n*CONTACT PAIR, INTERACTION=i, TIED\nouter, inner\n");
  const Ran tied = call_on("tied.inp");
  ASSERT_EQ(tied.status, 0) << tied.err;
  const std::string told = "the mesh file has *CONTACT PAIR, TIED, *EQUATION (2 times), *TIE: constraints";
  EXPECT_NE(tied.summary()["warnings"].dump().find(told), std::string::npos);
  EXPECT_NE(tied.text("run.log").find("warning: " + told), std::string::npos);
  EXPECT_NE(tied.text("run.log").find("skipped in the mesh file: *ELASTIC, *END STEP"), std::string::npos);
  EXPECT_EQ(call_on("shell.inp").summary()["warnings"].dump().find("constraints"), std::string::npos);
  testing::internal::CaptureStdout();
  call_on("tied.inp", {}, "check");
  EXPECT_NE(testing::internal::GetCapturedStdout().find("warning: " + told), std::string::npos);
}

TEST_F(ForeignMeshes, ConditionsThatChooseNothingAreRefused) {
  expect_refused(call_on("shell.msh", {"mesh.sets={end: \"X < -1\"}"}, "check"),
                 {"mesh.sets.end: 'X < -1' holds at none of", "X from 0 to 2"});
  expect_refused(call_on("shell.msh", {"mesh.surfaces={end: \"X > 1.9\"}"}, "check"),
                 {"mesh.surfaces.end", "at all nodes of none of", "outer faces"});
  expect_refused(call_on("shell.msh", {"mesh.surfaces={inner: \"X < 1\"}"}, "check"),
                 {"mesh.surfaces.inner", "the mesh has a surface 'inner' already"});
  expect_refused(call_on("shell.msh", {"mesh.sets={end: \"X + 1\"}"}, "check"), {"is no condition"});
  expect_refused(call_on("shell.msh", {"mesh.regions=material"}, "check"), {"`regions` is given for a mesh"});
  expect_refused(call_on("shell.vtu", {"mesh.regions=material"}, "check"),
                 {"shell.vtu: there is no cell array 'material'", "it has: region"});
}

}  // namespace
}  // namespace bulbus::test
