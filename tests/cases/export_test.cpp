// Models for other programs: what is read back is what was written, and nothing is left out in silence.
#include "app/export/export_file.hpp"
#include "app/export/export_scene.hpp"
#include "core/mesh/abaqus/abaqus.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "core/mesh/vtk/xml.hpp"
#include "tests/cases/run_case.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus::test {
namespace {

const std::string scene = R"(title: a shell of two layers, pressed from inside
mesh: {file: shell.msh}
regions: {soft: {c10: 50 kPa}, stiff: {c10: 80 kPa, c01: 20 kPa}}
symmetry: [x, y, z]
steps:
  - name: inflate
    increments: 2
    loads: [{surface: inner, pressure: 5 kPa}]
  - name: pull
    displace: [{set: pole, z: 0.2}]
probes:
  - {name: outside, kind: displacement, set: outer}
  - {name: pull, kind: reaction, set: pole, component: z, of: part}
  - {name: stress, kind: mises}
)";

class Export : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fresh_folder("bulbus_export_" + std::to_string(getpid()));
    write_gmsh(shell(), file("shell.msh"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static Mesh shell() {
    Mesh mesh = generate(ShellShape{.n = 3, .layers = 2});
    mesh.region_names = {"stiff", "soft"};
    for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
      mesh.region[e] = norm(center(mesh, static_cast<int>(e))) < 1.5 ? 1 : 0;
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n)
      if (mesh.points[n][0] < 1e-9 && mesh.points[n][1] < 1e-9) mesh.node_sets["pole"].push_back(n);
    add_interface(mesh);
    return mesh;
  }

  // Faces between the layers, once with normals out of the inner one and once with normals out of the other.
  static void add_interface(Mesh& mesh) {
    for (const Hex& h : mesh.hexes)
      for (const auto& f : hex_faces) {
        const Quad q{h[f[0]], h[f[1]], h[f[2]], h[f[3]]};
        if (!std::ranges::all_of(q, [&](int n) { return std::abs(norm(mesh.points[n]) - 1.5) < 1e-6; }))
          continue;
        const Point out = cross(mesh.points[q[2]] - mesh.points[q[0]], mesh.points[q[3]] - mesh.points[q[1]]);
        mesh.surfaces[dot(out, mesh.points[q[0]]) > 0 ? "from_soft" : "from_stiff"].push_back(q);
      }
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ifstream in(file(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Ran run_on(const std::string& mesh) { return call("run", folder_, "s.yaml", scene, {"mesh.file=" + mesh}); }
  // Status, what was printed and faults.
  Ran write(const std::string& name, std::vector<std::string> more = {}, std::string of = "") {
    if (of.empty()) std::ofstream(of = file("s.yaml")) << scene;
    std::vector<std::string> arguments{"export", of, "--to", file(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::ostringstream out, err;
    const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
    return {folder_, status, err.str(), out.str()};
  }
  void expect_told(const Ran& run, const std::string& name, const std::vector<std::string>& parts) {
    EXPECT_EQ(run.status, 0) << run.err;
    for (const std::string& part : not_empty(parts)) {
      EXPECT_NE(run.out.find("not in it: " + part), std::string::npos) << part << "\n" << run.out;
      EXPECT_NE(text(name).find("not in this file: " + part), std::string::npos) << part;
    }
  }

  std::filesystem::path folder_;
};

TEST_F(Export, IsReadBackWithIdenticalFigures) {
  const Ran written = write("shell.inp");
  ASSERT_EQ(written.status, 0) << written.err;
  const auto wanted = run_on("shell.msh").summary()["probes"];
  const Ran again = run_on("shell.inp");
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_GT(wanted["outside"].get<double>(), 0.01);
  EXPECT_EQ(again.summary()["probes"], wanted);
}

TEST_F(Export, KeepsNumbersSetsAndSurfaces) {
  ASSERT_EQ(write("shell.inp").status, 0);
  const Mesh wanted = read_gmsh(file("shell.msh")), mesh = read_abaqus(file("shell.inp")).mesh;
  EXPECT_EQ(mesh.points, wanted.points);
  EXPECT_EQ(mesh.hexes, wanted.hexes);
  EXPECT_EQ(mesh.region, wanted.region);
  EXPECT_EQ(mesh.region_names, wanted.region_names);
  const FaceTable faces(mesh.hexes);
  for (const auto& [name, quads] : not_empty(wanted.surfaces)) {
    ASSERT_EQ(mesh.surfaces.at(name).size(), quads.size()) << name;
    for (std::size_t i = 0; i < quads.size(); ++i)
      EXPECT_EQ(faces.directed(mesh.surfaces.at(name)[i]), faces.directed(quads[i])) << name;
  }
  EXPECT_EQ(mesh.node_sets.at("pole"), nodes_of(wanted, "pole"));
  EXPECT_EQ(mesh.node_sets.at("outer"), nodes_of(wanted, "outer"));  // of a probe
  EXPECT_FALSE(mesh.node_sets.at("symmetry_x").empty());
}

/// A face between two hexahedra belongs to the one that its normal points out of.
TEST_F(Export, KeepsTheSideOfAFace) {
  const Mesh mesh = shell();
  Model model;
  for (const std::string& region : mesh.region_names) model.regions[region].c10 = 1;
  const std::string heading = "a shell";
  write_inp(file("sides.inp"), {heading, mesh, model, exported_model(model, mesh), {}});
  const auto surfaces = read_abaqus(file("sides.inp")).mesh.surfaces;
  const FaceTable faces(mesh.hexes);
  for (const char* name : {"from_soft", "from_stiff"})
    for (std::size_t i = 0; i < not_empty(surfaces.at(name)).size(); ++i)
      EXPECT_EQ(faces.directed(surfaces.at(name)[i]), faces.directed(mesh.surfaces.at(name)[i])) << name;
  EXPECT_NE(faces.directed(surfaces.at("from_soft")[0]), faces.directed(surfaces.at("from_stiff")[0]));
}

TEST_F(Export, TellsMaterialsAndSteps) {
  ASSERT_EQ(write("shell.inp", {"--bulk", "100"}).status, 0);
  const std::string inp = text("shell.inp");
  for (const char* part :
       {"*ELEMENT, TYPE=C3D8I\n", "*MATERIAL, NAME=soft\n*HYPERELASTIC, NEO HOOKE\n0.05, 0.2\n",
        "*HYPERELASTIC, MOONEY-RIVLIN\n0.08, 0.02, 0.1\n", "*DSLOAD\ninner, P, 0.005\n",
        "*BOUNDARY\npole, 3, 3, 0.2\n", "symmetry_y, 2, 2\n", "*NODE PRINT, NSET=pole, TOTALS=YES\n"})
    EXPECT_NE(inp.find(part), std::string::npos) << part;
  ASSERT_EQ(write("hybrid.inp", {"--element", "C3D8H"}).status, 0);
  EXPECT_NE(text("hybrid.inp").find("NEO HOOKE\n0.05, 0.\n"), std::string::npos);
}

TEST_F(Export, EndsLoadsThatLaterStepsReplace) {
  std::ofstream(file("loads.yaml")) << R"(mesh: {block: {nx: 1, ny: 1, nz: 1}}
regions: {block: {c10: 50 kPa}}
fix: [{set: xmin}]
steps:
  - {name: first, loads: [{set: xmax, force: [0.001, 0, 0]}, {surface: zmax, pressure: 1 kPa}]}
  - {name: second, loads: [{set: xmax, force: [0, 0.002, 0]}, {surface: zmax, pressure: 1 kPa, dead: true}]}
  - {name: third, loads: [{surface: zmax, pressure: 3 kPa}]}
)";
  const Ran run = write("loads.inp", {}, file("loads.yaml"));
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string all = text("loads.inp");
  const std::string second = all.substr(all.find("'second'"), all.find("'third'") - all.find("'second'"));
  const std::string third = all.substr(all.find("'third'"));
  EXPECT_NE(second.find("\n2, 1, 0.\n2, 2, 0.002\n"), std::string::npos) << second;
  EXPECT_NE(second.find("zmax, P, 0.\n"), std::string::npos) << second;
  EXPECT_NE(third.find("zmax, P, 0.003\n"), std::string::npos) << third;
  EXPECT_NE(third.find("\n5, 3, 0.\n"), std::string::npos) << third;
}

TEST_F(Export, WritesFebio) {
  const Ran run = write("shell.feb");
  // `pull` begins where `inflate` leads to: such a start has no curve in FEBio.
  expect_told(run, "shell.feb", {"probes that are no displacement, position or reaction: stress", "step 2"});
  const std::string feb = text("shell.feb");
  const XmlElement root = parse_xml("shell.feb", feb);
  EXPECT_EQ(root.name, "febio_spec");
  EXPECT_EQ(root.attribute("version"), "4.0");
  const Mesh mesh = read_gmsh(file("shell.msh"));
  std::size_t elements = 0;
  for (const XmlElement& part : not_empty(root.part("Mesh")->parts))
    if (part.name == "Elements") elements += part.parts.size();
  EXPECT_EQ(elements, mesh.hexes.size());
  EXPECT_EQ(root.part("Mesh")->part("Nodes")->parts.size(), mesh.points.size());
  EXPECT_EQ(root.part("Material")->parts.size(), 2u);
  EXPECT_EQ(root.part("Boundary")->parts.size(), 3u);
  EXPECT_EQ(root.part("Loads")->parts.size(), 1u);
  EXPECT_EQ(root.part("Step")->parts.size(), 1u);
  EXPECT_NE(feb.find("<pt>1,0.005</pt>"), std::string::npos);
}

TEST_F(Export, TellsWhatHasNoEquivalent) {
  const std::string data = BULBUS_DATA;
  expect_told(write("a.inp", {}, data + "/scenes/sphere_liquid.yaml"), "a.inp",
              {"step 2 'inject': liquid 'inside' is enclosed as a fluid cavity"});
  EXPECT_NE(text("a.inp").find("inner, P, 0.0019998"), std::string::npos);  // 15 mmHg
  expect_told(write("b.feb", {}, data + "/scenes/suture.yaml"), "b.feb", {"suture '", "rigid body '"});
  expect_told(write("c.inp", {}, data + "/scenes/zonules.yaml"), "c.inp", {"bars '", "region '"});
  expect_told(write("d.inp", {}, data + "/scenes/two_blocks.yaml"), "d.inp", {"contact '"});
}

TEST_F(Export, GivesNamesThatAreRead) {
  const Ran run =
      write("a.inp",
            {"--set",
             "mesh={block: {nx: 2}, sets: {\"1\": \"X < 0.1\", \"the end\": \"X > 0.9\", XMIN: \"X < 0.1\"}}",
             "regions={block: {terms: [{r: 2, s: 2, c: 1}], c10: 1}}", "symmetry=[]",
             "fix=[{set: \"1\"}, {set: XMIN}, {set: xmin}]", "steps=[{}]", "probes=[]"});
  expect_told(run, "a.inp", {"region 'block' has powers up to 4"});
  const Mesh mesh = read_abaqus(file("a.inp")).mesh;
  for (const char* name : {"N1", "the_end", "XMIN", "xmin_2"})
    EXPECT_TRUE(mesh.node_sets.contains(name)) << name;
  for (const char* told : {"node set '1' goes by the name N1", "node set 'the end' goes by the name the_end"})
    EXPECT_NE(run.out.find(told), std::string::npos) << run.out;
}

TEST_F(Export, LeavesNamesOfTheMeshToTheMesh) {
  ASSERT_EQ(write("a.inp", {"--set", "mesh={block: {nx: 2}, surfaces: {symmetry_x: \"Z > 0.9\"}}",
                            "regions={block: {c10: 1}}", "symmetry=[x]", "fix=[{set: symmetry_x}]",
                            "steps=[{}]", "probes=[]"})
                .status,
            0);
  const Mesh mesh = read_abaqus(file("a.inp")).mesh;
  EXPECT_EQ(mesh.node_sets.at("symmetry_x"), nodes_of(mesh, "symmetry_x"));
  for (int n : not_empty(mesh.node_sets.at("symmetry_x"))) EXPECT_EQ(mesh.points[n][2], 1);
  for (int n : not_empty(mesh.node_sets.at("symmetry_x_"))) EXPECT_EQ(mesh.points[n][0], 0);
}

TEST_F(Export, RefusesWhatItCannotWrite) {
  EXPECT_EQ(write("a.stl").status, 2);
  EXPECT_NE(write("a.stl").err.find("end it in .inp"), std::string::npos);
  EXPECT_EQ(write("no/such/folder.inp").status, 1);
  for (const char* wrong :
       {"regions={}", "regions.soft={fung: {a: 1, b: 2}}", "steps.0.loads.0.pressure=log(s - 2)"})
    EXPECT_EQ(write("a.inp", {"--set", wrong}).status, 2) << wrong;
  for (const char* bulk : {"nan", "-nan", "NaN", "inf", "0"})
    EXPECT_EQ(write("a.inp", {"--bulk", bulk}).status, 2) << bulk;
}

TEST(Decimal, FitsInTwentyCharacters) {
  for (const double x : {0., 1., -1., 0.1, 1 / 3., -2 / 3., 123456.7890123456, 1e17, -10 / 3., 0.1 + 0.2}) {
    EXPECT_EQ(std::stod(decimal(x)), x) << decimal(x);
    EXPECT_LE(decimal(x).size(), 20u) << decimal(x);
    EXPECT_NE(decimal(x).find('.'), std::string::npos) << decimal(x);
  }
  for (const double x : {1 / 300., -1e-4 / 3, -1e-5 / 3, 6.123233995736766e-17, -1e-15 / 3, 1e-18 / 3, -1e-30,
                         -1e-200 / 3, 1e300 / 3}) {
    EXPECT_NEAR(std::stod(decimal(x)), x, 1e-12 * std::abs(x)) << decimal(x);
    EXPECT_LE(decimal(x).size(), 20u) << decimal(x);
  }
}

}  // namespace
}  // namespace bulbus::test
