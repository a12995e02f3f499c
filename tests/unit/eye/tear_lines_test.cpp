#include "app/eye/tear_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bulbus {
namespace {

// Every 5 degrees, as those of the eye are at n = 14 or so.
std::vector<double> lines(double from, double to) {
  std::vector<double> all;
  for (double t = from; t <= to; t += 5) all.push_back(t);
  return all;
}

TearLines around(const TearEdges& edges) { return {edges, lines(10, 120), 90, lines(0, 180)}; }

TEST(TearLines, LieOnTheEdges) {
  const TearLines tear = around({93.2, 102.8, 6.5});
  for (double azimuth : {0., 1., 5.}) {
    EXPECT_EQ(tear(95, azimuth).first, 93.2);
    EXPECT_EQ(tear(105, azimuth).first, 102.8);
  }
  for (double t : {95., 99., 105.}) EXPECT_EQ(tear(t, 5).second, 6.5);
}

TEST(TearLines, LeaveEquatorAndEndsAndWhatIsFarAlone) {
  for (const TearEdges& edges : {TearEdges{93.2, 102.8, 6.5}, {83, 97, 6}, {77, 88.5, 4}, {108, 116.5, 4}}) {
    const TearLines tear = around(edges);
    const auto stays = [&](double t, double azimuth) {
      EXPECT_EQ(tear(t, azimuth), std::pair(t, azimuth)) << edges.back;
    };
    for (double azimuth : {0., 3., 40., 180.}) {
      EXPECT_EQ(tear(90, azimuth).first, 90);
      for (double t : {0., 10., 120., 140., 180.}) stays(t, azimuth);
    }
    for (double t : {30., 95., 110.}) stays(t, 60);
    EXPECT_EQ(tear(95, 0).second, 0);
  }
}

// No cell is turned inside out.
TEST(TearLines, KeepTheOrderOfLines) {
  for (double back = 70; back < 100; back += 1.7)
    for (double length : {4., 7., 12.}) {
      const TearLines tear = around({back, back + length, 6.9});
      for (double azimuth = 0; azimuth < 40; azimuth += 2.5)
        for (double t = 10; t < 120; t += 2.5) {
          const auto here = tear(t, azimuth), ahead = tear(t + 2.5, azimuth), beside = tear(t, azimuth + 2.5);
          const double along = ahead.first - here.first, turned = ahead.second - here.second;
          const double across = beside.second - here.second, slid = beside.first - here.first;
          EXPECT_GT(along * across - turned * slid, .1 * 2.5 * 2.5) << back;
        }
    }
}

TEST(TearLines, DoNotMoveWhereCellsWouldBeDrawnOut) {
  for (const TearEdges& edges : {TearEdges{93, 93.5, 6}, {93, 103, 1}, {93, 103, 178}}) {
    const TearLines tear = around(edges);
    EXPECT_EQ(tear(95, 5), std::pair(95., 5.)) << edges.side;
  }
}

}  // namespace
}  // namespace bulbus
