// Runs that are ended from outside: what they leave, and that they go on. Records that are compared.
#include <csignal>

#include "core/base/interrupt.hpp"
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

Ran interrupted_by(int signal) {
  const InterruptsHeeded heeded;
  std::raise(signal);
  return run_case("interrupted");
}

int called(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
  if (status == 2) ADD_FAILURE() << err.str();
  return status;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Interrupt, EndsWithTheSignalsStatusAndWholeRecords) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Ran run = interrupted_by(signal);
    EXPECT_EQ(run.status, 128 + signal) << run.err;
    EXPECT_EQ(run.summary()["converged"], false);
    EXPECT_EQ(run.summary()["reason"], "interrupted");
    EXPECT_NE(run.text("run.log").find(std::string("interrupted by ") + name_of_interrupt(signal)),
              std::string::npos);
    EXPECT_TRUE(run.wrote("checkpoint.h5"));  // though the scene asks for none
    EXPECT_FALSE(run.summary().contains("diagnosis"));
    ASSERT_EQ(called({"report", run.folder / "out"}), 0);
    const std::string page = content(run.folder / "out/report.html");
    EXPECT_NE(page.find("The run was interrupted; "), std::string::npos);
    EXPECT_NE(page.find("with --restart goes on."), std::string::npos);
    EXPECT_EQ(page.find("did not converge"), std::string::npos);
  }
}

// Before it has solved anything itself.
TEST(Interrupt, OfARestartIntoAnotherFolderLeavesACheckpointThere) {
  const auto folder = interrupted_by(SIGTERM).folder;
  {
    const InterruptsHeeded heeded;
    std::raise(SIGTERM);
    EXPECT_EQ(called({"run", folder / "s.yaml", "-o", folder / "other", "--restart", folder / "out"}),
              128 + SIGTERM);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "other/checkpoint.h5"));
  EXPECT_EQ(called({"run", folder / "s.yaml", "-o", folder / "other", "--restart"}), 0);
}

// Of what a rehearsal cannot know: how much liquid the steps before have left.
TEST(LaterStep, ThatIsWrongEndsTheRunWithItsRecords) {
  const Ran run = run_case("overdrained");
  ASSERT_EQ(run.status, 1) << run.err;
  const auto summary = run.summary();
  EXPECT_EQ(summary["converged"], false);
  EXPECT_EQ(summary["totals"]["increments"], 2);
  const std::string reason = summary["reason"];
  for (const char* part : {"step 'drain' cannot begin: steps.2.add.inside: 4200 mm3 are drained", "'inside'"})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_EQ(summary["diagnosis"], "Drain less than there is.");
  EXPECT_NE(run.text("run.log").find("not converged: step 'drain' cannot begin"), std::string::npos);
  ASSERT_TRUE(run.wrote("checkpoint.h5"));  // though the scene asks for none
  const std::string less = "steps.drain.add.inside=-0.1 mL", scene = run.folder / "s.yaml";
  ASSERT_EQ(called({"run", scene, "-o", run.folder / "again", "--restart", run.folder / "out"}), 1);
  EXPECT_TRUE(std::filesystem::exists(run.folder / "again/checkpoint.h5"));
  const auto again = nlohmann::json::parse(content(run.folder / "again/summary.json"));
  EXPECT_EQ(again["reason"], summary["reason"]);
  for (const auto& [name, value] : summary["probes"].items())
    EXPECT_NEAR(again["probes"][name], value, 1e-12 * std::abs(value.get<double>())) << name;
  ASSERT_EQ(called({"run", scene, "-o", run.folder / "out", "--restart", "--set", less}), 0);
  ASSERT_EQ(called({"run", scene, "-o", run.folder / "whole", "--set", less}), 0);
  EXPECT_EQ(run.summary()["totals"]["increments"], 4);
  EXPECT_EQ(called({"compare", run.folder / "out", run.folder / "whole", "--relative", "1e-9"}), 0);
}

TEST(LaterStep, ThatIsWrongIsARowOfAStudy) {
  const Ran study = run_case("overdrained", {}, "study.yaml", "study");
  EXPECT_EQ(study.status, 1) << study.err;
  const auto rows = study.lines("study.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NE(rows[1].find("false,\"step 'drain' cannot begin"), std::string::npos) << rows[1];
  for (int k : {2, 3}) EXPECT_NE(rows[k].find(",true,"), std::string::npos) << rows[k];
}

TEST(LaterStep, WhoseFormulaEndsAmidItEndsTheRunWithItsRecords) {
  const Ran run = run_case("not_a_number",
                           {"steps=[{name: a, displace: [{set: xmax, x: 0.1}]}, {name: b, increments: 4, "
                            "displace: [{set: xmax, x: \"0.1*s/(abs(s-0.75)>1e-9)\"}]}]"},
                           "div0.yaml");
  ASSERT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(run.summary()["totals"]["increments"], 3);
  const std::string reason = run.summary()["reason"];
  for (const char* part : {"step 'b' stopped at 0.5 of its way: steps.1.displace.0.x", "s = 0.75"})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_TRUE(run.wrote("checkpoint.h5"));
}

TEST(Interrupt, LeavesWhatARestartGoesOnFrom) {
  const Ran left = interrupted_by(SIGTERM);
  std::ostringstream out, err;
  const std::string folder = left.folder;
  const int status = command_line({"run", folder + "/s.yaml", "-o", folder + "/out", "--restart"},
                                  Comm(MPI_COMM_SELF), out, err);
  ASSERT_EQ(status, 0) << err.str();
  EXPECT_EQ(left.summary()["totals"]["increments"], 2);
  EXPECT_NEAR(probe(left, "length"), 1.4, 1e-9);
}

TEST(Interrupt, OfAnEarlierRunIsForgotten) {
  interrupted_by(SIGINT);
  EXPECT_EQ(run_case("interrupted").status, 0);
}

TEST(UnnamedSteps, AreComparedOneByOne) {
  const Ran run = run_case("unnamed_steps");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string folder = run.folder, other = folder + "/other";
  const std::vector<std::string> again{"run", folder + "/s.yaml", "-o", other};
  ASSERT_EQ(called(again), 0);
  EXPECT_EQ(called({"compare", folder + "/out", other}), 0);
  auto changed = again;
  changed.insert(changed.end(), {"--set", "steps.0.displace.0.x=0.2"});  // of the first step alone
  ASSERT_EQ(called(changed), 0);
  EXPECT_EQ(called({"compare", folder + "/out", other}), 1);
}

}  // namespace
}  // namespace bulbus::test
