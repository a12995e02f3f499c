#include "contact/law/contact_area.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bulbus {
namespace {

constexpr NodeInContact closed{1, -1e-6}, open{0, 1e9};
constexpr std::array<double, 4> unit_edges{1, 1, 1, 1};

TEST(PartInContact, OfAnEdgeIsThatOfTheFieldsAtTheEndOfAContact) {
  const double K = 3, modulus = 7, length = .4;
  for (double theta = .02; theta < 1; theta += .03) {
    const double d = theta * length,
                 mean = 2. / 3 * K / length *
                        (std::pow(d + length / 2, 1.5) - std::pow(std::max(0., d - length / 2), 1.5));
    const double gap = 4. / 3 * K / modulus * std::pow(length - d, 1.5);
    EXPECT_NEAR(part_in_contact({mean, -1e-6}, {0, gap}, length, modulus), theta, 1e-8);
  }
}

TEST(PartInContact, OfAnEdgeStaysOnIt) {
  EXPECT_NEAR(part_in_contact(closed, {0, 0}, 1, 5), 1, 1e-8);
  EXPECT_NEAR(part_in_contact(closed, open, 1, 5), 0, 1e-5);
  EXPECT_EQ(part_in_contact(closed, open, 1, 0), .5) << "moduli not known";
}

TEST(PartInContact, OfAFaceIsThatOfAPolygon) {
  const NodeInContact half{0, .1};
  const double modulus = 4 * std::pow(.5, 1.5) / (3 * .1 * 2. / 3);  // ends contact in the middle of an edge
  EXPECT_EQ(part_in_contact({closed, closed, closed, closed}, unit_edges, modulus), 1);
  EXPECT_EQ(part_in_contact({half, half, half, half}, unit_edges, modulus), 0);
  EXPECT_NEAR(part_in_contact({closed, closed, half, half}, unit_edges, modulus), .5, 1e-8);
  EXPECT_NEAR(part_in_contact({half, closed, closed, half}, unit_edges, modulus), .5, 1e-8);
  for (int i = 0; i < 4; ++i) {
    std::array<NodeInContact, 4> one{half, half, half, half}, three{closed, closed, closed, closed},
        two = one;
    one[i] = closed, three[i] = half, two[i] = two[(i + 2) % 4] = closed;
    EXPECT_NEAR(part_in_contact(one, unit_edges, modulus), .125, 1e-8);
    EXPECT_NEAR(part_in_contact(three, unit_edges, modulus), .875, 1e-8);
    EXPECT_NEAR(part_in_contact(two, unit_edges, modulus), .75, 1e-8) << "joined across the middle";
  }
}

TEST(AreaInContact, IsContinuousWhereAPointBeginsToTouch) {
  const Comm alone(MPI_COMM_SELF);
  const std::vector<PointInContact> two{{1, 3}, {2, 4}};
  const double mean = (3 + 16) / 11.;
  EXPECT_EQ(area_in_contact(two, alone), 7);
  EXPECT_EQ(area_in_contact({}, alone), 0);
  for (const auto& [pressure, counted] :
       {std::pair{1e-12, 0.}, {.005 * mean, 1.}, {.01 * mean, 2.}, {mean, 2.}}) {
    std::vector<PointInContact> three = two;
    three.push_back({pressure, 2});
    EXPECT_NEAR(area_in_contact(three, alone), 7 + counted, 5e-3);
  }
}

TEST(AreaInContact, OfHertzIsHis) {
  std::vector<PointInContact> points;
  constexpr int rings = 100000;
  for (int i = 0; i < rings; ++i) {
    const double r2 = (i + .5) / rings;  // rings of equal area
    points.push_back({std::sqrt(1 - r2), 1. / rings});
  }
  EXPECT_NEAR(area_in_contact(points, Comm(MPI_COMM_SELF)), 1, 1e-4);
  EXPECT_LT(area_in_contact(points, Comm(MPI_COMM_SELF)), 1);
}

}  // namespace
}  // namespace bulbus
