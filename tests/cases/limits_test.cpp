// Inputs that would eat the machine: huge counts, nested aliases, files that claim more than they hold,
// limits of memory.
#include <sys/resource.h>

#include <cmath>
#include <numbers>

#include "core/base/memory.hpp"
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

const std::string block = R"yaml(mesh: {block: {nx: 2, ny: 2, nz: 2}}
regions: {block: {c10: 50 kPa}}
fix: [{set: xmin}]
steps: [{displace: [{set: xmax, x: 0.1}]}]
)yaml";

const std::string with_body = R"yaml(mesh: {block: {nx: 2, ny: 2, nz: 2}}
regions: {block: {c10: 50 kPa}}
fix: [{set: zmin}]
rigid_bodies: {lid: {plane: {point: [0, 0, 2], normal: [0, 0, -1]}}}
contacts: [{name: lid, slave: zmax, master: lid}]
steps: [{move: [{body: lid, translate: [0, 0, -0.5]}]}]
)yaml";

Ran checked(const std::string& yaml, const std::vector<std::string>& set = {}) {
  return run_scene(yaml, set, "check");
}

// Refused, and nothing was made before.
void expect_refused_in_time(const Ran& run, double before, const std::vector<std::string>& parts) {
  expect_refused(run, parts);
  EXPECT_LT(static_cast<double>(peak_resident_bytes()) - before, 300e6) << run.err;
}

double peak() { return static_cast<double>(peak_resident_bytes()); }

TEST(HugeCounts, AreRefusedBeforeAnythingIsMade) {
  const double before = peak();
  const auto mesh = [](const std::string& m) { return checked(block, {"mesh={" + m + "}"}); };
  expect_refused_in_time(mesh("block: {nx: 10000, ny: 10000, nz: 10000}"), before,
                         {"mesh: ", "1e+12 hexahedra", "Take fewer cells"});
  expect_refused_in_time(mesh("block: {nx: 600, ny: 600, nz: 600}"), before,
                         {"MB of memory", "take fewer cells"});
  expect_refused_in_time(mesh("shell: {n: 2000, layers: 2000}"), before, {"2.4e+10 hexahedra"});
  expect_refused_in_time(mesh("ball: {n: 1000, layers: 1000}"), before, {"hexahedra"});
  expect_refused_in_time(mesh("cylinder: {n: 1000, rings: 1000, layers: 100000}"), before,
                         {"1.2e+12 hexahedra"});
  expect_refused_in_time(mesh("block: {nx: 40, ny: 40, nz: 40}, refine: 8"), before, {"refine less often"});
  expect_refused_in_time(checked(block, {"mesh={eye: {n: 200}}"}), before, {"MB of memory"});
}

TEST(HugeCounts, OfOtherThanCellsAreRefusedToo) {
  const double before = peak();
  expect_refused_in_time(checked(with_body, {"rigid_bodies.lid={band: {parts: 3600, facets: 10000}}"}),
                         before, {"rigid_bodies.lid", "facets", "fewer parts"});
  const auto contact = [](std::vector<std::string> set) {
    for (const char* s : {"mesh.block.nx=12", "mesh.block.ny=12", "mesh.block.nz=1"}) set.emplace_back(s);
    return checked(with_body, set);
  };
  expect_refused_in_time(contact({"contacts.0.divisions=100"}), before,
                         {"contacts.0", "1.44e+06 points of contact 'lid' on 144 faces", "2 to 4 suffice"});
  expect_refused_in_time(contact({"mesh.refine=2", "contacts.0.divisions=50"}), before,
                         {"contacts.0", "5.76e+06 points", "on 2.3e+03 faces"});
  expect_refused_in_time(contact({"contacts.0.divisions=60", "solver.linear.memory_limit=500"}), before,
                         {"contacts.0", "5.18e+05 points", "881 MB of memory", "memory_limit allows"});
  const std::string parts = "rigid_bodies.lid={band: {parts: 3600, facets: 1}}";
  expect_refused_in_time(contact({"contacts.0.divisions=8", parts}), before,
                         {"contacts.0", "3.32e+07 pairs of points", "parts of 'lid'", "fewer parts"});
  expect_refused_in_time(checked(with_body, {"rigid_bodies.lid={sphere: {facets: 1000}}"}), before,
                         {"rigid_bodies.lid", "8e+06 facets"});
}

TEST(HugeCounts, OfASectionsCornersAreRefused) {
  std::string corners;
  for (int i = 0; i < 20001; ++i)
    corners += (i ? ", [" : "[") + std::to_string(2 * std::cos(i * std::numbers::pi / 10000.5)) + ", " +
               std::to_string(9 + 2 * std::sin(i * std::numbers::pi / 10000.5)) + "]";
  const std::string swept =
      "rigid_bodies.lid={swept: {spline: true, parts: 1, facets: 1, section: [" + corners + "]}}";
  const double before = peak();
  expect_refused_in_time(checked(with_body, {swept}), before + 200e6,
                         {"section", "20001 corners", "at most 20000"});
}

TEST(HugeCounts, OfDivisionsAreNoneOnAFewFaces) {
  EXPECT_EQ(checked(with_body, {"contacts.0.divisions=100"}).status, 0);
}

TEST(HugeCounts, OfAMeshFileAreRefusedWhereItIsRefined) {
  expect_refused(
      run_case("hexahedra_twice", {"mesh.file=../../data/meshes/two_blocks.msh"}, "s.yaml", "check"),
      {"cannot read the mesh file"});
  expect_refused(run_case("partitioned_mesh", {"mesh.refine=8"}, "s.yaml", "check"),
                 {"mesh: ", "refine less often"});
}

TEST(HugeCounts, AreRefusedByMeshToo) {
  const auto folder = fresh_folder("bulbus_huge");
  std::ofstream(folder / "s.yaml") << block;
  std::ostringstream out, err;
  EXPECT_EQ(command_line({"mesh", folder / "s.yaml", "-o", folder / "m.msh", "--set", "mesh.block.nx=10000",
                          "mesh.block.ny=10000", "mesh.block.nz=10000"},
                         Comm(MPI_COMM_SELF), out, err),
            2);
  EXPECT_NE(err.str().find("more than can be numbered"), std::string::npos) << err.str();
}

TEST(MemoryLimit, OfTheShellIsThatOfTheMachine) {
  rlimit before{}, less{};
  getrlimit(RLIMIT_DATA, &before);
  less = before;
  less.rlim_cur = std::size_t{1} << 30;
  setrlimit(RLIMIT_DATA, &less);
  const Ran run = checked(
      block, {"mesh.block.nx=80", "mesh.block.ny=80", "mesh.block.nz=80", "solver.linear.method=iterative"});
  setrlimit(RLIMIT_DATA, &before);
  expect_refused(run, {"more than the 1074 MB that this machine has"});
}

TEST(Aliases, ThatMultiplyAreRefusedWithTheirLine) {
  const double before = peak();
  std::string yaml = "a0: &a0 x\n";
  for (int k = 1; k < 10; ++k) {
    yaml += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [";
    for (int i = 0; i < 10; ++i) yaml += (i ? ", *a" : "*a") + std::to_string(k - 1);
    yaml += "]\n";
  }
  expect_refused_in_time(checked(yaml), before, {"scene.yaml:", "more than 200000 values", "aliases"});
  expect_refused_in_time(checked("a: &a {b: &b [&c [x, y], *c, *c]}\nsteps: &s [{increments: &n 3}, "
                                 "{increments: *n}]\n<<: {d: *s}\n"),
                         before, {"unknown key"});
}

TEST(Yaml, IsBounded) {
  const double before = peak();
  expect_refused_in_time(checked("a: " + std::string(100000, '[')), before, {"scene.yaml:1: "});
  std::string nested;
  for (int k = 0; k < 2000; ++k) nested += std::string(k, ' ') + "a:\n";
  expect_refused_in_time(checked(nested), before, {"scene.yaml:"});
  expect_refused_in_time(checked("title: " + std::string(5 << 20, 'x') + "\n"), before, {"more than 4 MB"});
  std::string keys;
  for (int k = 0; k < 100000; ++k) keys += "k" + std::to_string(k) + ": 1\n";
  expect_refused_in_time(checked(keys), before + 200e6, {"scene.yaml:1: unknown key 'k0'"});
  expect_refused_in_time(checked(keys + "k0: 2\n"), before + 200e6,
                         {"scene.yaml:100001: ", "given twice", "line 1 "});
  std::ostringstream out, err;
  EXPECT_EQ(command_line({"check", "/dev/zero"}, Comm(MPI_COMM_SELF), out, err), 2);
  EXPECT_NE(err.str().find("more than 4 MB"), std::string::npos) << err.str();
}

TEST(Yaml, HasNoZeroCharacters) {
  expect_refused(checked("title: \"a\\0b\"\n" + block),
                 {"scene.yaml:1: ", "code 0", "write it again without"});
  expect_refused(checked("\"a\\0b\": 1\n" + block), {"scene.yaml:1: ", "code 0"});
}

// What a file holds counts, not what it claims.
TEST(Claims, OfFilesAllocateNothing) {
  const double before = peak();
  const auto folder = fresh_folder("bulbus_claims");
  const auto check_with = [&](const std::string& scene, const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return call("check", folder, "s.yaml", scene, {});
  };
  std::string stl(200, '\0');
  stl.replace(80, 4, "\xff\xff\xff\xff");
  const std::string body =
      replaced(with_body, "plane: {point: [0, 0, 2], normal: [0, 0, -1]}", "file: {path: b.stl}");
  expect_refused_in_time(check_with(body, "b.stl", stl), before,
                         {"s.yaml:4: ", "b.stl", "200 bytes", "4294967295 triangles", "cut short"});
  const std::string mesh = replaced(block, "block: {nx: 2, ny: 2, nz: 2}", "file: m.msh");
  const std::string start = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  expect_refused_in_time(check_with(mesh, "m.msh", start + "9000000000000\n1 0 0 0\n"), before,
                         {"m.msh:7: ", "ends too early"});
  const std::string start4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n";
  expect_refused_in_time(
      check_with(mesh, "m.msh", start4 + "1 9000000000000 1 9000000000000\n3 1 0 9000000000000\n1\n"), before,
      {"m.msh:8: ", "ends too early"});
  std::filesystem::remove(folder / "m.msh");
  std::filesystem::create_directory(folder / "m.msh");
  expect_refused(call("check", folder, "s.yaml", mesh, {}), {"cannot read the mesh file"});
}

TEST(SlipsOfMeaning, AreRefused) {
  expect_refused(checked(block, {"symmetry=[y, z, y]"}), {"symmetry.2", "given twice"});
  expect_refused(
      checked(with_body, {"steps.0.move=[{body: lid, translate: [0, 0, -0.1]}, {body: lid, close: 0.2}]"}),
      {"steps.0.move.1.body", "moved twice"});
  expect_refused(checked(block, {"steps.0.displace.0.x=0x7f"}), {"steps.0.displace.0.x", "hexadecimal"});
  expect_refused(checked(block, {"regions.block.c10=0x1p-4"}), {"regions.block.c10", "hexadecimal"});
  expect_refused(checked(block, {"probes=[{name: time, kind: mises}]"}), {"probes.0.name", "column 'time'"});
  expect_refused(checked(with_body, {"steps.0.move.0.translate=[0, 2147483647, 0]"}),
                 {"steps.0.move.0.translate", "thousand times"});
  expect_refused(checked(with_body, {"contacts.0.tolerance=1000"}), {"contacts.0.tolerance"});
  expect_refused(checked(with_body, {"rigid_bodies.lid.plane.point=[0, 0, 1e9]"}),
                 {"rigid_bodies.lid", "diagonals"});
  expect_refused(checked(block, {"steps.0.loads=[{set: zmax, force: [1e30, 0, 0]}]"}),
                 {"steps.0.loads.0.force"});
  // squares that overflow or vanish turned directions into nothing
  expect_refused(
      checked(block,
              {"steps.0.loads=[{surface: zmax, pressure: 1 kPa, dead: true, direction: [0, -1e308, -1]}]"}),
      {"direction", "beyond all measure"});
  expect_refused(
      checked(block, {"steps.0.displace=[{set: xmax, rotate: {axis: [0, 1e200, 1], angle: 0.1}}]"}),
      {"axis", "beyond all measure"});
  expect_refused(checked(with_body, {"rigid_bodies.lid.direction=[0, 0, 1e-300]"}),
                 {"direction", "beyond all measure"});
  EXPECT_EQ(checked(block).status, 0);
  EXPECT_EQ(checked(with_body).status, 0);
}

// Only the last would count.
TEST(GivenTwice, InOneStepIsRefused) {
  const auto step = [](const std::string& content) { return checked(block, {"steps.0={" + content + "}"}); };
  expect_refused(step("displace: [{set: xmax, x: 0.1}, {set: xmax, x: 0.2}]"),
                 {"steps.0.displace.1", "'xmax'", "x", "only the last would count"});
  expect_refused(step("displace: [{set: xmax, x: 0.1}, {set: xmax, translate: [0, 1, 0]}]"),
                 {"steps.0.displace.1", "'xmax'"});
  EXPECT_EQ(step("displace: [{set: xmax, x: 0.1}, {set: xmax, y: 0.1}, {set: ymax, z: 0}]").status, 0);
}

TEST(OverConstrained, NamesStepAndSet) {
  expect_refused(checked(block, {"steps=[{displace: [{set: xmax, x: 0.1}, {set: block, x: 0.2}]}]"}),
                 {"steps.0.displace", "over-constrained", "one of them by 'block/x'"});
}

}  // namespace
}  // namespace bulbus::test
