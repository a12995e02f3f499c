#include "contact/search/position_codes.hpp"

#include <gtest/gtest.h>

#include "tests/support/numbers.hpp"
#include "tests/support/sheets.hpp"

namespace bulbus {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

Candidates brute_force(std::span<const double> points, const Triangles& triangles,
                       std::span<const double> places, double inflation) {
  Candidates all;
  for (std::size_t i = 0; i < points.size() / 3; ++i) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      bool in = true;
      for (int c = 0; c < 3; ++c) {
        const auto& [a, b, d] = triangles[t];
        const auto [low, high] = std::minmax({places[3 * a + c], places[3 * b + c], places[3 * d + c]});
        in = in && points[3 * i + c] >= low - inflation && points[3 * i + c] <= high + inflation;
      }
      if (in) all.triangles.push_back(static_cast<int>(t));
    }
    all.start.push_back(all.triangles.size());
  }
  return all;
}

void expect_all(std::span<const double> points, const Triangles& triangles, std::span<const double> places,
                double inflation) {
  const Candidates found = find_candidates(points, triangles, places, inflation),
                   all = brute_force(points, triangles, places, inflation);
  EXPECT_EQ(found.start, all.start);
  EXPECT_EQ(found.triangles, all.triangles);
}

TEST(Candidates, EqualBruteForceOnRandomConfigurations) {
  std::size_t pairs = 0;
  for (int seed = 0; seed < 1000; ++seed) {
    const int points = 1 + static_cast<int>(20 * std::abs(noise(seed, 1))),
              corners = 3 + static_cast<int>(15 * std::abs(noise(seed, 2)));
    const double size = std::pow(10, 2 * noise(seed, 3)),
                 flat = noise(seed, 6) > 0 ? 1 : 0;  // half of them in one plane
    auto x = noise_vector(3 * points, seed + 10000), places = noise_vector(3 * corners, seed + 20000);
    for (std::size_t i = 2; i < x.size(); i += 3) x[i] *= flat;
    for (double& v : places) v *= size;
    Triangles triangles(10);
    for (int t = 0; t < 10; ++t)
      for (int i = 0; i < 3; ++i)
        triangles[t][i] = static_cast<int>(std::abs(noise(seed, 100 + 3 * t + i)) * (corners - 1));
    const double inflation = .2 * std::abs(noise(seed, 5));
    expect_all(x, triangles, places, inflation);
    pairs += find_candidates(x, triangles, places, inflation).triangles.size();
  }
  EXPECT_GT(pairs, 5000u);
}

TEST(Candidates, OfAGroupHoldThoseOfEachOfItsPoints) {
  constexpr int group = 4;
  auto points = noise_vector(3 * 25 * group, 1);
  const auto middles = noise_vector(3 * 25, 3), places = noise_vector(3 * 40, 2);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = .02 * points[i] + middles[3 * (i / (3 * group)) + i % 3];
  Triangles triangles(30);
  for (int t = 0; t < 30; ++t)
    for (int i = 0; i < 3; ++i) triangles[t][i] = (7 * t + 13 * i) % 40;
  const Candidates grouped = find_candidates(points, triangles, places, .05, group),
                   single = find_candidates(points, triangles, places, .05);
  EXPECT_EQ(grouped.start.size(), 26u);
  EXPECT_LT(grouped.triangles.size(), single.triangles.size());
  for (int i = 0; i < 25 * group; ++i) EXPECT_TRUE(std::ranges::includes(grouped.of(i), single.of(i))) << i;
}

/// Slave nodes just off a master sheet, both bent by a map.
void expect_all_on(const std::function<Vec3<double>(double, double, double)>& bend, double off) {
  Sheets master, slave;
  const Facets facets = split(master.add(17, 13, [&](double u, double v) { return bend(u, v, 0); }));
  slave.add(23, 19, [&](double u, double v) { return bend(u, v, off); });
  for (double inflation : {.01, .1, .3}) expect_all(slave.X, facets.triangles, master.X, inflation);
  EXPECT_GT(find_candidates(slave.X, facets.triangles, master.X, .1).triangles.size(), slave.X.size() / 3);
}

TEST(Candidates, EqualBruteForceOnASmoothSurface) {
  expect_all_on(
      [](double u, double v, double h) {
        return Vec3<double>{u, v, .1 * std::sin(3 * u + v) + h};
      },
      .02);
}

TEST(Candidates, EqualBruteForceOnAFoldedSurface) {
  expect_all_on(
      [](double u, double v, double h) {
        return Vec3<double>{std::sin(5 * u) + h, v, .3 * std::cos(10 * u) + u};
      },
      .02);
}

TEST(Candidates, EqualBruteForceOnLayers) {
  Sheets sheets;
  auto faces = sheets.add(12, 12, [](double u, double v) { return Vec3<double>{3 * u, 3 * v, 0}; });
  const auto upper = sheets.add(9, 9, [](double u, double v) { return Vec3<double>{3 * u, 3 * v, .15}; });
  faces.insert(faces.end(), upper.begin(), upper.end());
  Sheets slave;
  slave.add(20, 20, [](double u, double v) { return Vec3<double>{3 * u, 3 * v, .05}; });
  expect_all(slave.X, split(faces).triangles, sheets.X, .06);
  expect_all(slave.X, split(faces).triangles, sheets.X, .2);
}

TEST(Candidates, AreFewWhereOneTriangleIsHuge) {
  Sheets slave, master;
  slave.add(30, 30, [](double u, double v) { return Vec3<double>{u, v, 0}; });
  auto faces = master.add(30, 30, [](double u, double v) { return Vec3<double>{u, v, .01}; });
  faces.push_back(master.add(1, 1, [](double u, double v) {
    return Vec3<double>{1e4 * u - 5e3, 1e4 * v - 5e3, .3};
  })[0]);
  expect_all(slave.X, split(faces).triangles, master.X, .02);
}

TEST(Candidates, ExistWithoutPointsOrTriangles) {
  EXPECT_EQ(find_candidates({}, Triangles{{0, 1, 2}}, std::vector<double>(9), .1).start.size(), 1u);
  EXPECT_TRUE(find_candidates(std::vector<double>(6), {}, {}, .1).of(1).empty());
}

TEST(GlobalSearch, SearchesAnewOnlyWhenTheMarginIsUsedUp) {
  Sheets slave, master;
  slave.add(10, 10, [](double u, double v) { return Vec3<double>{u, v, 0}; });
  const auto triangles = split(master.add(14, 14, [](double u, double v) {
                           return Vec3<double>{u, v, .01};
                         })).triangles;
  GlobalSearch search(.05, .1);
  auto x = slave.X;
  for (int step = 0; step < 40; ++step) {  // slides .4 in all
    for (std::size_t i = 0; i < x.size(); i += 3) x[i] += .01;
    const Candidates& kept = search.update(x, triangles, master.X);
    const Candidates needed = brute_force(x, triangles, master.X, .05);
    for (int p = 0; p < slave.nodes(); ++p)
      ASSERT_TRUE(std::ranges::includes(kept.of(p), needed.of(p))) << step;
  }
  EXPECT_GT(search.searches(), 4);
  EXPECT_LT(search.searches(), 12);
}

TEST(GlobalSearch, NoticesTheMastersMotion) {
  Sheets slave, master;
  slave.add(3, 3, [](double u, double v) { return Vec3<double>{u, v, 0}; });
  const auto triangles = split(master.add(3, 3, [](double u, double v) {
                           return Vec3<double>{u, v, 5};
                         })).triangles;
  GlobalSearch search(.1, .1);
  EXPECT_TRUE(search.update(slave.X, triangles, master.X).triangles.empty());
  for (std::size_t i = 2; i < master.X.size(); i += 3) master.X[i] = .05;
  EXPECT_FALSE(search.update(slave.X, triangles, master.X).triangles.empty());
  EXPECT_EQ(search.searches(), 2);
}

}  // namespace
}  // namespace bulbus
