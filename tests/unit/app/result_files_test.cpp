#include <gtest/gtest.h>

#include <cmath>

#include "core/io/hdf5_read.hpp"
#include "tests/support/left.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

/// Two contacts, two bodies and a suture, saved at the start and after every second of ten increments.
const Ran& small_run() {
  static const Ran ran =
      call("run", fresh_folder("bulbus_result_files"), "scene.yaml", full_of_memory,
           {"output.fields=[displacement, pressure, region, gap, contact_pressure, contact_status, "
            "stress, mises, strain, principal_stresses, principal_stretches]"});
  return ran;
}

std::vector<double> field(int number, const std::string& name) {
  return read_dataset(small_run().folder / "out" / result_file(number), "VTKHDF/" + name);
}

TEST(ResultFiles, BeginWithTheStateBeforeAnyLoad) {
  ASSERT_EQ(small_run().status, 0) << small_run().err;
  const auto files = nlohmann::json::parse(small_run().text("result.hdf.series"))["files"];
  ASSERT_EQ(files.size(), 6u);
  EXPECT_EQ(files[0]["name"], "result_0000.hdf");
  EXPECT_EQ(files[0]["time"], 0);
  EXPECT_EQ(files[5]["time"], 4);
  for (double u : field(0, "PointData/displacement")) EXPECT_EQ(u, 0);
  for (double stretch : field(0, "CellData/principal_stretches")) EXPECT_NEAR(stretch, 1, 1e-6);
  for (double J : field(0, "CellData/J")) EXPECT_NEAR(J, 1, 1e-6);
  for (const char* file : {"bodies_0000.vtp", "lines_0000.vtp"}) EXPECT_TRUE(small_run().wrote(file)) << file;
}

TEST(ResultFiles, NameRegionsBodiesAndGroupsOfLines) {
  EXPECT_EQ(field(10, "FieldData/region_shell"), std::vector<double>{0});
  EXPECT_NE(
      small_run().text("bodies_0010.vtp").find("Name=\"body_tire\" NumberOfTuples=\"1\" format=\"ascii\">1<"),
      std::string::npos);
  EXPECT_NE(small_run().text("lines_0010.vtp").find("Name=\"group_string\""), std::string::npos);
}

TEST(ResultFiles, ShowASutureWhileItPulls) {
  EXPECT_NE(small_run().text("lines_0006.vtp").find("NumberOfLines=\"0\""), std::string::npos);
  EXPECT_NE(small_run().text("lines_0008.vtp").find("NumberOfLines=\"1\""), std::string::npos);
  EXPECT_NE(small_run().text("lines.pvd").find("timestep=\"4\" part=\"0\" file=\"lines_0010.vtp\""),
            std::string::npos);
}

/// Together: the smaller gap, the sum of pressures; NaN where no contact is.
TEST(ResultFiles, HaveTheFieldsOfEveryContact) {
  const auto together = field(10, "PointData/gap"), under = field(10, "PointData/gap_under"),
             pole = field(10, "PointData/gap_pole"), p = field(10, "PointData/contact_pressure"),
             p_under = field(10, "PointData/contact_pressure_under"),
             p_pole = field(10, "PointData/contact_pressure_pole"),
             status = field(10, "PointData/contact_status_pole"), X = field(10, "Points");
  int closed = 0;
  for (std::size_t n = 0; n < together.size(); ++n) {
    const bool outside = std::hypot(X[3 * n], X[3 * n + 1], X[3 * n + 2]) > 11.9;
    EXPECT_EQ(std::isnan(p[n]), !outside) << n;
    EXPECT_EQ(std::isnan(status[n]), !outside) << n;
    if (!outside) {
      EXPECT_TRUE(std::isnan(together[n])) << n;
      continue;
    }
    const double smaller = std::fmin(under[n], pole[n]);
    EXPECT_TRUE(together[n] == smaller || (std::isnan(together[n]) && std::isnan(smaller))) << n;
    EXPECT_NEAR(p[n], p_under[n] + p_pole[n], 1e-6 * std::abs(p[n])) << n;
    closed += status[n] == 1;
  }
  EXPECT_GT(closed, 0);
}

TEST(ResultFiles, DeriveStrainsFromTheDisplacements) {
  const auto E = field(10, "CellData/strain"), stretches = field(10, "CellData/principal_stretches"),
             stress = field(10, "CellData/stress"), principal = field(10, "CellData/principal_stresses");
  const std::size_t cells = E.size() / 6;
  ASSERT_EQ(stretches.size(), 3 * cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const double *s = &stretches[3 * c], *p = &principal[3 * c], *e = &E[6 * c], *t = &stress[6 * c];
    EXPECT_GE(s[0], s[1]);
    EXPECT_GE(s[1], s[2]);
    EXPECT_NEAR(s[0] * s[1] * s[2], 1, .05) << c;  // incompressible in the mean, not in the middle
    EXPECT_NEAR(s[0] * s[0] + s[1] * s[1] + s[2] * s[2], 3 + 2 * (e[0] + e[1] + e[2]), 1e-5) << c;
    EXPECT_GE(p[0], p[2]);
    EXPECT_NEAR(p[0] + p[1] + p[2], t[0] + t[1] + t[2], 1e-5 * (1 + std::abs(p[0]))) << c;
  }
}

}  // namespace
