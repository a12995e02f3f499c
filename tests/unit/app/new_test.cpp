#include <gtest/gtest.h>

#include "core/io/text_file.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

Ran calls(const fs::path& folder, const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  return {folder, status, err.str(), out.str()};
}

/// Writes a scene of that kind, checks it, runs it; its figures.
nlohmann::json figures_of_new(const std::string& kind) {
  const fs::path folder = fresh_folder("bulbus_new_" + kind), scene = folder / "mine.yaml";
  const Ran made = calls(folder, {"new", folder / "mine", "--kind", kind});
  EXPECT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find(scene.string()), std::string::npos);
  EXPECT_EQ(calls(folder, {"check", scene, "--quiet"}).status, 0);
  const Ran ran = calls(folder, {"run", scene, "-o", folder / "out"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const auto summary = ran.summary();
  EXPECT_EQ(summary["title"], "mine");
  EXPECT_TRUE(summary["warnings"].empty()) << summary["warnings"];
  return summary["probes"];
}

TEST(New, SphereRuns) {
  const auto figures = figures_of_new("sphere");
  EXPECT_GT(figures["pressure"], 15);
  EXPECT_GT(figures["outer_radius"], 11.4);
}

TEST(New, EyeRuns) {
  const auto figures = figures_of_new("eye");
  EXPECT_GT(figures["IOP"], 20);
  EXPECT_LT(figures["IOP"], 40);
}

TEST(New, MeshRuns) {
  const auto figures = figures_of_new("mesh");
  EXPECT_NEAR(figures["top_z"], 12, 1e-9);
  const double l = 1.2,
               free = 1e3 * .04 * (l - 1 / (l * l)) * 16;  // mN, of a bar that may get thinner at its foot
  EXPECT_GT(figures["force"], free);
  EXPECT_LT(figures["force"], 1.1 * free);
  const Mesh mesh = read_gmsh(fs::temp_directory_path() / "bulbus_new_mesh" / "mine.msh");
  EXPECT_EQ(mesh.region_names, std::vector<std::string>{"tissue"});
  EXPECT_TRUE(mesh.surfaces.contains("top"));
}

TEST(New, IsAnEyeUnlessAnotherKindIsNamed) {
  const fs::path folder = fresh_folder("bulbus_new");
  EXPECT_EQ(calls(folder, {"new", folder / "a.yaml"}).status, 0);
  EXPECT_NE(content_of(folder / "a.yaml").find("eye: {n: 8}"), std::string::npos);
  EXPECT_EQ(content_of(folder / "a.yaml").find("NAME"), std::string::npos);
}

TEST(New, WritesOverNothing) {
  const fs::path folder = fresh_folder("bulbus_new");
  std::ofstream(folder / "a.yaml") << "mine";
  std::ofstream(folder / "b.msh") << "mine";
  const Ran first = calls(folder, {"new", folder / "a"});
  EXPECT_EQ(first.status, 2);
  EXPECT_EQ(first.err, (folder / "a.yaml").string() +
                           ": is there already, and nothing is written over it\n  Take another name, or move "
                           "it away.\n");
  EXPECT_EQ(calls(folder, {"new", folder / "b", "--kind", "mesh"}).status, 2);
  EXPECT_EQ(content_of(folder / "a.yaml") + content_of(folder / "b.msh"), "minemine");
  EXPECT_FALSE(fs::exists(folder / "b.yaml"));
  EXPECT_EQ(calls(folder, {"new", folder / "no" / "a"}).status, 2);
  EXPECT_EQ(calls(folder, {"new", folder / "c", "--kind", "cube"}).status, 2);
}

}  // namespace
