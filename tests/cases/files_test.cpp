// Files that a run reads and writes: changed inputs, folders in use, files of other people, names that lead
// elsewhere.
#include "core/io/folder_lock.hpp"
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
  expect_refused(run_in(folder, "scene.yaml", {"--restart"}),
                 {"checkpoint.h5: ", "m.stl", "rigid_bodies.ball.file.path", "run without --restart"});
  EXPECT_EQ(content(folder), before);
  fs::copy_file(folder / "good.stl", folder / "m.stl", fs::copy_options::overwrite_existing);
  write(folder / "scene.yaml", "# a comment\n" + read(folder / "scene.yaml"));
  EXPECT_EQ(run_in(folder, "scene.yaml", {"--restart"}).status, 0);
}

/// Surfaces and sets are no part of what was compared before.
TEST(ChangedInput, OfAMeshIsRefused) {
  const auto folder = copy_of("interrupted");
  ASSERT_EQ(command(folder, {"mesh", folder / "s.yaml", "-o", folder / "m.msh", "--text"}).status, 0);
  write(folder / "s.yaml",
        replaced(read(folder / "s.yaml"), "{block: {upper: [1,1,1], nx: 2, ny: 2, nz: 2}}", "{file: m.msh}"));
  ASSERT_EQ(run_in(folder, "s.yaml", {"--set", "output.checkpoint=1"}).status, 0);
  std::string mesh = read(folder / "m.msh");
  for (const auto& [from, to] :
       {std::pair{"\"zmax\"", "\"\""}, {"\"ymax\"", "\"zmax\""}, {"\"\"", "\"ymax\""}})
    mesh = replaced(mesh, from, to);
  write(folder / "m.msh", mesh);
  expect_refused(run_in(folder, "s.yaml", {"--restart"}), {"m.msh", "mesh.file", "run without --restart"});
}

/// A study takes no run for its own that was of another file.
TEST(ChangedInput, IsNoFinishedRunOfAStudy) {
  const auto folder = copy_of("restart_other_body");
  fs::copy_file(folder / "good.stl", folder / "m.stl");
  write(
      folder / "study.yaml",
      "scene: scene.yaml\nvary: [{name: stiffness, keys: [regions.block.c10], values: [50 kPa, 60 kPa]}]\n");
  const auto study = [&] { return command(folder, {"study", folder / "study.yaml", "-o", folder / "out"}); };
  ASSERT_EQ(study().status, 0);
  const std::string first = read(folder / "out/run_001/summary.json");
  ASSERT_EQ(study().status, 0);
  EXPECT_EQ(read(folder / "out/run_001/summary.json"), first);
  fs::copy_file(folder / "other.stl", folder / "m.stl", fs::copy_options::overwrite_existing);
  ASSERT_EQ(study().status, 0);
  EXPECT_NE(read(folder / "out/run_001/summary.json"), first);
}

TEST(FolderInUse, IsRefusedAndNotTouched) {
  const auto folder = copy_of("interrupted");
  ASSERT_EQ(run_in(folder, "s.yaml").status, 0);
  const auto before = content(folder);
  {
    const FolderLock other(folder / "out");
    expect_refused(run_in(folder, "s.yaml"), {"out: another run is writing into this folder", "-o"});
    EXPECT_EQ(command(folder, {"check", folder / "s.yaml"}).status, 0);
  }
  EXPECT_EQ(content(folder), before);
  EXPECT_EQ(run_in(folder, "s.yaml").status, 0);
}

TEST(FolderInUse, OfAStudyOrOneOfItsRunsIsRefused) {
  const auto folder = copy_of("interrupted");
  write(folder / "study.yaml",
        "scene: s.yaml\nvary: [{name: stiffness, keys: [regions.block.c10], values: [50 kPa, 60 kPa]}]\n");
  for (const char* used : {"out", "out/run_002"}) {
    fs::create_directories(folder / used);
    const FolderLock other(folder / used);
    expect_refused(command(folder, {"study", folder / "study.yaml", "-o", folder / "out"}),
                   {std::string(used) + ": another run is writing"});
    EXPECT_FALSE(fs::exists(folder / "out/run_001"));
  }
}

TEST(FilesOfOthers, AreNotOverwritten) {
  for (const char* name : {"summary.json", "run.log", "history.csv", "resolved.yaml", "checkpoint.h5",
                           "result_0002.hdf", "result_0001.hdf.tmp", "bodies.pvd", "manifest.txt"}) {
    const auto folder = copy_of("interrupted");
    fs::create_directories(folder / "out");
    write(folder / "out" / name, "mine");
    const auto before = content(folder);
    expect_refused(run_in(folder, "s.yaml"), {name, "Move it away, or name another folder with -o."});
    EXPECT_EQ(content(folder), before);
  }
}

TEST(FilesOfOthers, LastThroughRunsAndRestarts) {
  const auto folder = copy_of("interrupted");
  fs::create_directories(folder / "out/result_0001");
  for (const char* name :
       {"result_final.hdf", "bodies_paper.vtp", "result_.hdf", "checkpoint.h5.old", "out.tmp"})
    write(folder / "out" / name, name);
  ASSERT_EQ(run_in(folder, "s.yaml", {"--set", "output.checkpoint=1"}).status, 0);
  ASSERT_EQ(run_in(folder, "s.yaml", {"--restart"}).status, 0);
  ASSERT_EQ(run_in(folder, "s.yaml", {"--set", "output.vtk=false"}).status, 0);
  for (const char* name :
       {"result_final.hdf", "bodies_paper.vtp", "result_.hdf", "checkpoint.h5.old", "out.tmp"})
    EXPECT_EQ(read(folder / "out" / name), name);
  EXPECT_FALSE(fs::exists(folder / "out/result_0001.hdf"));
}

/// A manifest that somebody wrote by hand takes nothing away elsewhere.
TEST(Manifest, EndsAtItsFolder) {
  const auto folder = copy_of("interrupted");
  ASSERT_EQ(run_in(folder, "s.yaml").status, 0);
  write(folder / "mine.txt", "mine");
  std::ofstream(folder / "out/manifest.txt", std::ios::app) << "../mine.txt\n"
                                                            << (folder / "mine.txt").string() << "\n";
  ASSERT_EQ(run_in(folder, "s.yaml").status, 0);
  EXPECT_EQ(read(folder / "mine.txt"), "mine");
}

TEST(NameOfOutput, StaysInsideOfTheFolder) {
  for (const std::string name :
       {"/bulbus_elsewhere", "../elsewhere", "a/../../elsewhere", "summary.json", "run.log/x"})
    for (const char* verb : {"check", "run"}) {
      const Ran r = run_case("interrupted", {"solver.linear.dump=" + name}, "s.yaml", verb);
      expect_refused(r, {"solver.linear.dump", name});
      EXPECT_FALSE(fs::exists(r.folder / "out"));
    }
  EXPECT_TRUE(
      run_case("interrupted", {"solver.linear.dump=deep/systems"}).wrote("deep/systems/system_0001.h5"));
}

TEST(NameOfOutput, MayLeadElsewhereByALinkOfTheUser) {
  const auto folder = copy_of("interrupted");
  fs::create_directories(folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out");
  EXPECT_EQ(run_in(folder, "s.yaml").status, 0);
  EXPECT_TRUE(fs::exists(folder / "elsewhere/summary.json"));
}

TEST(FolderThatCannotBe, IsRefusedBeforeAnyComputing) {
  const auto folder = copy_of("interrupted");
  write(folder / "file", "mine");
  fs::create_symlink(folder / "nowhere", folder / "link");
  fs::create_directories(folder / "taken/run.log");
  for (const char* out : {"file", "file/below", "link", "taken"}) {
    const Ran r = command(folder, {"run", folder / "s.yaml", "-o", folder / out});
    expect_refused(
        r, {(folder / out).string() + ": cannot be made a folder of results", "Name another with -o."});
  }
  EXPECT_EQ(command(folder, {"run", folder / "s.yaml", "-o", folder / "some/where/else"}).status, 0);
}

}  // namespace
}  // namespace bulbus::test
