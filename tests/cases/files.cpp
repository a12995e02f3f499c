// Files that a run reads and writes.
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

namespace fs = std::filesystem;

fs::path copy_of(const std::string& name) {
  const auto copy = fresh_folder("bulbus_files_" + std::to_string(getpid()));
  fs::copy(std::string(BULBUS_CASES) + "/" + name, copy, fs::copy_options::recursive);
  return copy;
}

Ran command(const fs::path& folder, std::vector<std::string> arguments) {
  std::ostringstream out, err;
  const int status = command_line(std::move(arguments), Comm(MPI_COMM_SELF), out, err);
  return {folder, status, err.str(), out.str()};
}
Ran run_in(const fs::path& folder, const std::string& scene, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"run", folder / scene, "-o", folder / "out"});
  return command(folder, more);
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Names and contents.
std::map<std::string, std::string> content(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) all[entry.path()] = read(entry.path());
  return all;
}

TEST(ChangedInput, OfABodyIsRefused) {
  const auto folder = copy_of("restart_other_body");
  fs::copy_file(folder / "good.stl", folder / "m.stl");
  ASSERT_EQ(run_in(folder, "scene.yaml").status, 0);
  fs::copy_file(folder / "other.stl", folder / "m.stl", fs::copy_options::overwrite_existing);
  const auto before = content(folder);
  expect_refused(run_in(folder, "scene.yaml", {"--restart"}), {"checkpoint.h5: ", "m.stl", "rigid_bodies.ball.file.path", "run without --restart"});
  EXPECT_EQ(content(folder), before);
  fs::copy_file(folder / "good.stl", folder / "m.stl", fs::copy_options::overwrite_existing);
  write(folder / "scene.yaml", "# a comment\n" + read(folder / "scene.yaml"));
  EXPECT_EQ(run_in(folder, "scene.yaml", {"--restart"}).status, 0);
}

/// Surfaces and sets are no part of what was compared before.
TEST(ChangedInput, OfAMeshIsRefused) {
  const auto folder = copy_of("interrupted");
  ASSERT_EQ(command(folder, {"mesh", folder / "s.yaml", "-o", folder / "m.msh", "--text"}).status, 0);
  write(folder / "s.yaml", replaced(read(folder / "s.yaml"), "{block: {upper: [1,1,1], nx: 2, ny: 2, nz: 2}}", "{file: m.msh}"));
  ASSERT_EQ(run_in(folder, "s.yaml", {"--set", "output.checkpoint=1"}).status, 0);
  std::string mesh = read(folder / "m.msh");
  for (const auto& [from, to] : {std::pair{"\"zmax\"", "\"\""}, {"\"ymax\"", "\"zmax\""}, {"\"\"", "\"ymax\""}}) mesh = replaced(mesh, from, to);
  write(folder / "m.msh", mesh);
  expect_refused(run_in(folder, "s.yaml", {"--restart"}), {"m.msh", "mesh.file", "run without --restart"});
}

/// A study takes no run for its own that was of another file.
TEST(ChangedInput, IsNoFinishedRunOfAStudy) {
  const auto folder = copy_of("restart_other_body");
  fs::copy_file(folder / "good.stl", folder / "m.stl");
  write(folder / "study.yaml", "scene: scene.yaml\nvary: [{name: stiffness, keys: [regions.block.c10], values: [50 kPa, 60 kPa]}]\n");
  const auto study = [&] { return command(folder, {"study", folder / "study.yaml", "-o", folder / "out"}); };
  ASSERT_EQ(study().status, 0);
  const std::string first = read(folder / "out/run_001/summary.json");
  ASSERT_EQ(study().status, 0);
  EXPECT_EQ(read(folder / "out/run_001/summary.json"), first);
  fs::copy_file(folder / "other.stl", folder / "m.stl", fs::copy_options::overwrite_existing);
  ASSERT_EQ(study().status, 0);
  EXPECT_NE(read(folder / "out/run_001/summary.json"), first);
}

}  // namespace
}  // namespace bulbus::test
