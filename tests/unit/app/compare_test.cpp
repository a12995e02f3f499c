#include <gtest/gtest.h>

#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

const std::string header =
    "increment,step,time,iop,\"the \"\"gap\"\", mm\",newton_iterations,krylov_iterations,cuts,seconds\n";

/// A folder with a history.
fs::path history(const std::string& name, const std::string& rows) {
  const fs::path folder = fresh_folder("bulbus_compare_" + name);
  std::ofstream(folder / "history.csv") << header << rows;
  return folder;
}

Ran compared(const fs::path& a, const fs::path& b, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"compare", a, b};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  return {a, status, err.str(), out.str()};
}

const std::string rows = "1,fill,0.5,5,,3,0,0,0.1\n2,fill,1,10,,3,0,0,0.1\n3,press,2,20,0.25,4,0,1,0.1\n";

TEST(Compare, FindsTwoRunsTheSame) {
  const Ran r = compared(history("a", rows), history("b", replaced(rows, ",0.1\n", ",99\n")));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("0 of 3 figures differ"), std::string::npos) << r.out;
}

/// What happens within a step does not count; tolerances are of the largest value, here 20.
TEST(Compare, TellsWhatDiffersAtTheEndsOfSteps) {
  const auto a = history("a", rows);
  EXPECT_EQ(compared(a, history("b", replaced(rows, "0.5,5,", "0.5,6,"))).status, 0);
  const auto b = history("b", replaced(rows, "1,10,", "1,10.01,"));
  const Ran r = compared(a, b);
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.out.find("differs"), std::string::npos);
  EXPECT_NE(r.out.find("1 of 3 figures differ"), std::string::npos) << r.out;
  EXPECT_EQ(compared(a, b, {"--relative", "1e-3"}).status, 0);
  EXPECT_EQ(compared(a, b, {"--absolute", "0.1"}).status, 0);
}

TEST(Compare, TakesMissingFiguresForDifferences) {
  const auto a = history("a", rows);
  EXPECT_EQ(compared(a, history("b", rows.substr(0, rows.find("3,press")))).status, 1);
  const Ran r = compared(a, history("b", replaced(rows, "20,0.25", "20,")));
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.out.find("only in the first\n"), std::string::npos) << r.out;
  EXPECT_EQ(r.out.find("only in the second"), std::string::npos) << r.out;
}

TEST(Compare, RefusesWhatIsNoFolderOfResults) {
  const auto a = history("a", rows), empty = fresh_folder("bulbus_compare_empty");
  for (const Ran& r : {compared(a, empty), compared(empty, a), compared(a, "/no/such/folder"),
                       compared(a, a, {"--relative", "-1"})})
    EXPECT_EQ(r.status, 2);
  EXPECT_NE(compared(a, empty).err.find("history.csv: cannot be read"), std::string::npos);
  std::ofstream(empty / "history.csv") << "a,b\n";
  EXPECT_EQ(compared(a, empty).status, 2);
  std::ofstream(empty / "history.csv") << header << "1,fill\n";
  EXPECT_EQ(compared(a, empty).status, 2);
  for (const char* cell : {"many", "nan", "5x"}) {
    const Ran r = compared(a, history("b", replaced(rows, "1,10,", std::string("1,") + cell + ",")));
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find("history.csv:3: '" + std::string(cell) + "' is no finite number"), std::string::npos)
        << r.err;
  }
}

TEST(Compare, NamesTheRunsOfAStudy) {
  const auto a = history("a", rows), study = fresh_folder("bulbus_compare_study");
  std::ofstream(study / "study.json") << "{}";
  const std::string said = study.string() +
                           ": is the folder of a study, not of a run\n  Name one of its runs, such as " +
                           (study / "run_001").string() + ".\n";
  EXPECT_EQ(compared(a, study).err, said);
  std::ostringstream out, err;
  EXPECT_EQ(command_line({"plot", study}, Comm(MPI_COMM_SELF), out, err), 2);
  EXPECT_EQ(command_line({"report", a, study}, Comm(MPI_COMM_SELF), out, err), 2);
  EXPECT_EQ(err.str(), said + said);
}

TEST(Compare, RefusesProbesOfTwoUnitsAndNothingToCompare) {
  const auto a = history("a", rows), b = history("b", rows);
  std::ofstream(a / "summary.json") << R"({"units": {"iop": "mmHg"}})";
  std::ofstream(b / "summary.json") << R"({"units": {"iop": "kPa"}})";
  const Ran r = compared(a, b);
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("'iop' is in 'mmHg' in the first run and in 'kPa'"), std::string::npos) << r.err;
  EXPECT_EQ(compared(history("a", ""), history("b", "")).status, 2);
}

TEST(PlotHistory, DrawsAPanelPerProbe) {
  const auto folder = history("plot", rows);
  const auto plot = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"plot", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::ostringstream out, err;
    return command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  };
  EXPECT_EQ(plot({}), 0);
  std::ifstream in(folder / "history.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  for (const char* word : {"<svg", "iop", "steps done"}) EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_EQ(plot({"iop", "-o", (folder / "one.svg").string()}), 0);
  EXPECT_TRUE(fs::exists(folder / "one.svg"));
  EXPECT_EQ(plot({"ipo"}), 2);
  EXPECT_EQ(plot({"-o", "/no/such/folder/a.svg"}), 1);
}

}  // namespace
