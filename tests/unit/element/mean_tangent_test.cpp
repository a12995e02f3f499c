#include "core/element/mean_tangent.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

std::vector<NodeSingle> rounded(std::span<const double> v) {
  std::vector<NodeSingle> s(v.size() / 3, NodeSingle{0, 0, 0, NAN});  // the fourth number must not matter
  for (std::size_t i = 0; i < v.size(); ++i) s[i / 3][i % 3] = static_cast<float>(v[i]);
  return s;
}

std::vector<double> single_action(const SolidTangent& tangent, std::span<const double> d) {
  std::vector<NodeSingle> force(d.size() / 3);
  tangent.apply_single(rounded(d), force);
  std::vector<double> f(d.size());
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = force[i / 3][i % 3];
  return f;
}

std::vector<double> mean_action(const SolidTangent& tangent, std::span<const double> d,
                                double augmentation = 1) {
  const BlockCsr A(static_cast<int>(d.size() / 3),
                   [&](const ContributionVisitor& v) { tangent.visit_mean(v, augmentation); });
  std::vector<double> f(d.size());
  A.apply(d, f);
  return f;
}

std::vector<double> exact_action(const SolidTangent& tangent, std::span<const double> d) {
  std::vector<double> f(d.size());
  tangent.apply(d, {}, f, {});
  return f;
}

struct MeanTangentTest : testing::Test, ThreeTissues {
  std::vector<double> d = noise_vector(X.size(), 11);
};

TEST_F(MeanTangentTest, IsAppliedInSinglePrecision) {
  for (double gamma : {0., 10.}) {
    linearise(x, lambda, gamma);
    const auto expected = mean_action(*tangent, d);
    EXPECT_LT(relative_difference(single_action(*tangent, d), expected), 2e-6);
    EXPECT_GT(relative_difference(expected, exact_action(*tangent, d)), 1e-4)
        << "these hexahedra are no parallelepipeds";
    EXPECT_LT(relative_difference(expected, exact_action(*tangent, d)), .2);
  }
}

TEST_F(MeanTangentTest, AddsToForces) {
  linearise(x, lambda, 10);
  std::vector<NodeSingle> force(X.size() / 3, NodeSingle{1, 1, 1, 0});
  tangent->apply_single(rounded(d), force);
  const auto alone = single_action(*tangent, d);
  for (std::size_t i = 0; i < alone.size(); ++i)
    EXPECT_NEAR(force[i / 3][i % 3], 1 + alone[i], 1e-5 * (1 + std::abs(alone[i])));
}

TEST_F(MeanTangentTest, FollowsTheLinearisedState) {
  linearise(X, lambda, 10, StrainSource::cache);
  const auto before = single_action(*tangent, d);
  linearise(x, lambda, 10, StrainSource::cache);
  EXPECT_LT(relative_difference(single_action(*tangent, d), mean_action(*tangent, d)), 2e-6);
  EXPECT_GT(relative_difference(before, mean_action(*tangent, d)), 1e-2);
}

TEST_F(MeanTangentTest, MatricesAreSymmetric) {
  linearise(x, lambda, 10);
  tangent->visit_mean([&](std::span<const int>, std::span<const double> K) {
    for (int i = 0; i < 24; ++i)
      for (int j = 0; j < i; ++j) ASSERT_EQ(K[24 * i + j], K[24 * j + i]);
  });
}

TEST_F(MeanTangentTest, MatricesTakeAPartOfTheAugmentation) {
  linearise(x, lambda, 10);
  const auto part = mean_action(*tangent, d, .1);
  linearise(x, lambda, 1);
  EXPECT_LT(relative_difference(part, mean_action(*tangent, d)), 1e-12);
}

TEST_F(MeanTangentTest, DoesNotFeelTranslations) {
  linearise(x, lambda, 10);
  const std::vector<double> shift(X.size(), .75);
  for (double f : single_action(*tangent, shift)) EXPECT_EQ(f, 0);
}

// An affine deformation of parallelepipeds: nothing varies within a hexahedron.
TEST_F(MeanTangentTest, IsExactOnParallelepipeds) {
  const auto X = places(shaken_block(3, 3, 3, 0));
  std::vector<double> x(X.size());
  const double F[3][3] = {{1.1, .3, -.1}, {-.2, .9, .25}, {.1, -.15, 1.05}};
  for (std::size_t i = 0; i < X.size(); ++i)
    for (int c = 0; c < 3; ++c) x[i] += F[i % 3][c] * X[i / 3 * 3 + c];
  const Solid solid(X, mesh.hexes, this->solid.regions());
  const SolidTangent tangent = tangent_of(solid, x, lambda, 10);
  EXPECT_LT(relative_difference(mean_action(tangent, d), exact_action(tangent, d)), 1e-12);
}

// Two displacements that are linear within the hexahedron.
TEST(MeanTangent, IsExactBetweenLinearDisplacements) {
  const Mesh mesh = shaken_block(1, 1, 1, .2);
  const auto X = places(mesh), x = deformed(X, 3);
  const std::vector<double> lambda{.4};
  Solid solid(X, mesh.hexes, {{"a", make_material({{1, 0, .8}, {0, 1, .3}}), 0, 1}});
  const SolidTangent tangent = tangent_of(solid, x, lambda, 0);
  const auto xi = places(shaken_block(1, 1, 1, 0));
  const auto linear = [&](int seed) {
    std::vector<double> d(24);
    for (int k = 0; k < 24; ++k)
      for (int i = 0; i < 3; ++i) d[k] += xi[k / 3 * 3 + i] * noise(seed, 3 * (k % 3) + i);
    return d;
  };
  for (int seed : {1, 2}) {
    const auto u = linear(seed), v = linear(seed + 2);
    const double expected = inner(v, exact_action(tangent, u));
    EXPECT_NEAR(inner(v, mean_action(tangent, u)), expected, 1e-12 * std::abs(expected));
  }
}

TEST(MeanTangent, FewerHexahedraThanLanes) {
  for (int n : {1, 3, 7, 8, 9, 16, 17, 25}) {
    Row row{n};
    const SolidTangent tangent = tangent_of(row.solid, row.x, row.lambda, 0, StrainSource::cache);
    EXPECT_LT(relative_difference(single_action(tangent, row.d), mean_action(tangent, row.d)), 2e-6) << n;
  }
}

}  // namespace
}  // namespace bulbus
