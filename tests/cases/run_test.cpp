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
