#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/command_line.hpp"
#include "app/version.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "scenes.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

struct Answer {
  int status;
  std::string out, err;
};

Answer bulbus_says(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  return {status, out.str(), err.str()};
}

/// A fresh folder that holds scene.yaml.
fs::path folder_with(const std::string& scene) {
  const fs::path folder = fs::temp_directory_path() / "bulbus_command";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "scene.yaml") << scene;
  return folder;
}

TEST(CommandLine, HelpsAndTellsItsVersion) {
  const Answer help = bulbus_says({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const char* command : {"new", "run", "study", "check", "mesh", "export", "matrix-market", "help",
                              "schema", "completion", "man"})
    EXPECT_NE(help.out.find(std::string("\n  ") + command), std::string::npos);
  EXPECT_NE(bulbus_says({"run", "--help"}).out.find("--set"), std::string::npos);
  EXPECT_EQ(bulbus_says({"--version"}).out, std::string("bulbus ") + version + "\n");
  EXPECT_NE(bulbus_says({"help", "scene"}).out.find("max_iterations"), std::string::npos);
  EXPECT_EQ(bulbus_says({"help", "scene"}).out.find("smoothing_range"), std::string::npos);
  EXPECT_NE(bulbus_says({"help", "scene", "--expert"}).out.find("smoothing_range"), std::string::npos);
  EXPECT_NE(bulbus_says({"help", "scene", "--all"}).out.find("record_spectrum"), std::string::npos);
  EXPECT_NE(bulbus_says({"help", "study"}).out.find("one_at_a_time"), std::string::npos);
  EXPECT_EQ(bulbus_says({"schema"}).out[0], '{');
  EXPECT_NE(bulbus_says({"schema", "study"}).out.find("\"one_at_a_time\""), std::string::npos);
}

TEST(CommandLine, HelpsOnCommandsKeysAndTheLog) {
  const std::string listed = bulbus_says({"help"}).out;
  for (const char* topic : {"scene", "study", "log", "run", "plot", "probes", "solver"})
    EXPECT_NE(listed.find(std::string("\n  ") + topic + " "), std::string::npos) << topic;
  EXPECT_EQ(bulbus_says({"help", "run"}).out, bulbus_says({"run", "--help"}).out);
  EXPECT_EQ(bulbus_says({"help", "steps"}).out, bulbus_says({"help", "scene.steps"}).out);
  EXPECT_NE(bulbus_says({"help", "log"}).out.find("\n  Krylov "), std::string::npos);
  const Answer wrong = bulbus_says({"help", "probe"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(wrong.err, "there is no topic 'probe'\n  did you mean 'probes'?\n");
}

TEST(CommandLine, HelpsOnValuesOfKeysAndOnUnits) {
  const std::string gap = bulbus_says({"help", "gap"}).out;
  EXPECT_EQ(gap.substr(0, gap.find('\n')), "'gap' is a value of probes.kind: what is recorded");
  EXPECT_NE(gap.find("\n  contact "), std::string::npos) << gap;
  EXPECT_EQ(gap.find("\n  liquid "), std::string::npos) << gap;
  const std::string volume = bulbus_says({"help", "volume"}).out;  // a key, and a value
  EXPECT_NE(volume.find("in solver.newton:\n"), std::string::npos) << volume;
  EXPECT_NE(volume.find("'volume' is a value of probes.kind"), std::string::npos) << volume;
  EXPECT_NE(bulbus_says({"help", "units"}).out.find("MPa, GPa, Pa, kPa, mmHg\n"), std::string::npos);
}

TEST(CommandLine, TellsTheVersionOfTheProject) {
  std::ifstream in(fs::path(BULBUS_DATA).parent_path() / "CMakeLists.txt");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(text.find(std::string("project(bulbus VERSION ") + version), std::string::npos);
}

TEST(CommandLine, WrongUsageIsStatusTwo) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                {"rn", "a.yaml"},
                                                {"run"},
                                                {"run", "a.yaml", "--fast"},
                                                {"help", "me"},
                                                {"mesh", "a.yaml"}}) {
    const Answer answer = bulbus_says(wrong);
    EXPECT_EQ(answer.status, 2);
    EXPECT_FALSE(answer.err.empty());
    EXPECT_TRUE(answer.out.empty());
  }
}

TEST(CommandLine, WrongUsageIsToldWithARemedy) {
  const std::string commands = "\n  'bulbus help' lists the commands\n";
  EXPECT_EQ(bulbus_says({}).err, "no command is given" + commands);
  EXPECT_EQ(bulbus_says({"fit"}).err, "there is no command 'fit'" + commands);
  EXPECT_EQ(bulbus_says({"runn", "a.yaml"}).err, "there is no command 'runn'\n  did you mean 'run'?\n");
  EXPECT_EQ(bulbus_says({"run", "a.yaml", "--sett", "title=b"}).err,
            "'bulbus run' has no option '--sett'\n  did you mean '--set'?\n");
  EXPECT_EQ(bulbus_says({"help", "buckle", "height"}).err,
            "'bulbus help' takes no further 'height'\n  'bulbus help --help' tells what it takes\n");
  EXPECT_EQ(bulbus_says({"run"}).err,
            "bulbus run: SCENE is required\n  'bulbus run --help' tells what it takes\n");
}

TEST(CommandLine, ASettingWithoutEffectIsStatusTwo) {
  const std::string scene = folder_with(least_scene()) / "scene.yaml";
  for (const char* command : {"run", "check"}) {
    const Answer answer =
        bulbus_says({command, scene, "--set", "solver.linear.method=direct", "solver.linear.restart=20"});
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.err,
              "--set solver.linear.restart=20: solver.linear.restart: has no effect: solver.linear.method is "
              "direct\n  Leave it out, or choose iterative for solver.linear.method.\n");
  }
}

TEST(CommandLine, WrongInputIsStatusTwoAndOnlyAMessage) {
  const fs::path folder = folder_with(least_scene("titel: a\n"));
  const std::string scene = folder / "scene.yaml";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", scene, "-o", folder / "out"},
        {"check", scene},
        {"mesh", scene, "-o", folder / "m.msh"}}) {
    const Answer answer = bulbus_says(arguments);
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.err, scene + ":4: unknown key 'titel'\n  did you mean 'title'?\n");
    EXPECT_TRUE(answer.out.empty());
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST(CommandLine, WritesTheMeshOfAScene) {
  const fs::path folder = folder_with(least_scene());
  const Answer answer = bulbus_says(
      {"mesh", "--set", "mesh.block.nx=2", "mesh.block.ny=3", folder / "scene.yaml", "-o", folder / "m.msh"});
  EXPECT_EQ(answer.status, 0) << answer.err;
  EXPECT_EQ(read_gmsh(folder / "m.msh").hexes.size(), 6u);
  EXPECT_EQ(bulbus_says({"mesh", folder / "scene.yaml", "-o", folder / "text.msh", "--text"}).status, 0);
  std::string first;
  std::ifstream text(folder / "text.msh");
  std::getline(text, first), std::getline(text, first);
  EXPECT_EQ(first, "2.2 0 8");
  MeshSource source;
  source.file = folder / "m.msh";
  EXPECT_EQ(make_meshes(source).base.points.size(), 24u);
  EXPECT_EQ(bulbus_says({"mesh", folder / "scene.yaml", "-o", folder / "no" / "m.msh"}).status, 2);
}

}  // namespace
