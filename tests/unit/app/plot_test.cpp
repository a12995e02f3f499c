#include <gtest/gtest.h>

#include "app/report/history_chart.hpp"
#include "core/base/process.hpp"
#include "core/io/text_file.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

/// A folder with a history of two probes, one of which is not known in the first step.
fs::path plotted_folder() {
  const fs::path folder = fresh_folder("bulbus_plot");
  std::ofstream(folder / "history.csv")
      << "increment,step,time,pull,growth,newton_iterations,krylov_iterations,cuts,seconds\n"
         "1,press,0.5,2,,4,40,0,0.25\n2,press,1,3,0.5,5,50,0,0.5\n";
  std::ofstream(folder / "history.units.json") << R"({"pull": "mN", "seconds": "s"})";
  return folder;
}

Ran plots(const fs::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"plot", folder};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  return {folder, status, err.str(), out.str()};
}

TEST(Plot, DrawsAnyColumnWithItsUnit) {
  const History history = read_history(plotted_folder());
  EXPECT_EQ(history.unit("pull") + history.unit("growth") + history.unit("seconds"), "mNs");
  const Chart chart = chart_of(history, {"pull", "seconds", "krylov_iterations"}, "time", "");
  ASSERT_EQ(chart.panels.size(), 3u);
  EXPECT_EQ(chart.panels[0].title, "pull [mN]");
  EXPECT_EQ(chart.panels[1].title, "seconds [s]");
  EXPECT_EQ(chart.panels[2].x_label, "steps done");
  EXPECT_EQ(chart.panels[2].series[0].marks[1].y, 50);
}

TEST(Plot, DrawsOverAnyColumnWhatIsKnownOfBoth) {
  const Chart chart = chart_of(read_history(plotted_folder()), {"growth", "seconds"}, "pull", "");
  EXPECT_EQ(chart.panels[0].x_label, "pull [mN]");
  ASSERT_EQ(chart.panels[0].series[0].marks.size(), 1u);
  EXPECT_EQ(chart.panels[0].series[0].marks[0].x, 3);
  EXPECT_EQ(chart.panels[1].series[0].marks.size(), 2u);
}

TEST(Plot, TakesUnitsOfEarlierRunsFromTheSummary) {
  const fs::path folder = plotted_folder();
  fs::remove(folder / "history.units.json");
  std::ofstream(folder / "summary.json") << R"({"units": {"pull": "kN"}})";
  EXPECT_EQ(read_history(folder).unit("pull"), "kN");
}

TEST(Plot, RefusesWhatIsNoColumnOfNumbers) {
  const fs::path folder = plotted_folder();
  EXPECT_EQ(plots(folder, {"puls"}).err,
            "there is no column 'puls' of numbers in the history\n  Did you mean 'pull'?\n");
  EXPECT_EQ(plots(folder, {"step"}).status, 2);
  EXPECT_EQ(plots(folder, {"pull", "--over", "growht"}).status, 2);
}

TEST(Plot, WritesSvgAndWhereItCanPng) {
  const fs::path folder = plotted_folder();
  EXPECT_EQ(plots(folder, {}).out, (folder / "history.svg").string() + "\n");
  const fs::path png = folder / "a.png";
  const Ran drawn = plots(folder, {"pull", "-o", png});
  if (find_program("rsvg-convert").empty()) {
    EXPECT_EQ(drawn.status, 2);
    EXPECT_NE(drawn.err.find("apt-get install librsvg2-bin"), std::string::npos) << drawn.err;
    EXPECT_FALSE(fs::exists(png));
  } else {
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(content_of(png).substr(1, 3), "PNG");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 3 + (drawn.status == 0));
}

TEST(Run, WritesTheUnitsOfItsHistoryAtTheStart) {
  const Ran r = run_scene(
      "mesh: {block: {nx: 2}}\nregions: {block: {c10: 0.5}}\nsymmetry: [x, y, z]\nsteps: [{displace: [{set: "
      "xmax, x: 0.1}]}]\nprobes: [{name: stress, kind: mises, unit: kPa}]\noutput: {vtk: false}\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.text("history.units.json")),
            nlohmann::json::parse(R"({"stress": "kPa", "seconds": "s"})"));
  EXPECT_NE(r.text("manifest.txt").find("history.units.json"), std::string::npos);
}

}  // namespace
