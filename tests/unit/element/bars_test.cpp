#include "core/element/bars.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "core/mesh/generate/embed.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

/// One bar from node to node, one from a face to a node, one from face to face with half its area.
struct BarsTest : testing::Test {
  Mesh mesh = shaken_block(2, 2, 2);
  std::vector<double> X = places(mesh), x = deformed(X, 5, .3), d = noise_vector(X.size(), 2);
  std::vector<Bar> list{{at_node(0), at_node(26)},
                        {{mesh.surfaces.at("zmin")[0], {.1, .2, .3, .4}}, at_node(25)},
                        {{mesh.surfaces.at("xmin")[1], {.25, 0, .5, .25}},
                         {mesh.surfaces.at("xmax")[2], {.7, .1, .1, .1}},
                         .5}};
  Bars bars{X, list, 100, .02, false};

  std::vector<double> force(const Bars& b, std::span<const double> at) const {
    std::vector<double> f(X.size());
    b.add_residual(at, f, {});
    return f;
  }
};

TEST_F(BarsTest, ForceIsDerivativeOfStrainEnergy) {
  const auto energy = [&](std::span<const double> at) {
    double sum = 0;
    for (const Bar& b : list) {
      const double L = norm(minus(place(b.b, X), place(b.a, X))),
                   l = norm(minus(place(b.b, at), place(b.a, at)));
      const double e = (l * l - L * L) / (2 * L * L);
      sum += .5 * 100 * e * e * .02 * b.share * L;
    }
    return std::vector{sum};
  };
  EXPECT_NEAR(inner(force(bars, x), d), derivative(energy, x, d)[0], 1e-9);
}

TEST_F(BarsTest, StiffnessIsDerivativeOfForce) {
  std::vector<double> f(X.size());
  bars.add_stiffness(x, d, f);
  EXPECT_LT(
      relative_difference(f, derivative([&](std::span<const double> at) { return force(bars, at); }, x, d)),
      1e-9);
}

TEST_F(BarsTest, VisitedMatricesActAsStiffness) {
  const BlockCsr A(27, [&](const ContributionVisitor& v) { bars.visit(x, v); });
  std::vector<double> f(X.size()), expected(X.size());
  A.apply(d, f);
  bars.add_stiffness(x, d, expected);
  EXPECT_LT(relative_difference(f, expected), 1e-13);
}

TEST_F(BarsTest, UndeformedBarsPullNothingButResistStretch) {
  EXPECT_LT(largest(force(bars, X)), 1e-13);
  EXPECT_LT(largest(bars.forces(X)), 1e-13);
  for (const Bars& b : {bars, Bars(X, list, 100, .02, true)}) {  // the first tangent of a run has both
    std::vector<double> f(X.size());
    b.add_stiffness(X, d, f);
    EXPECT_GT(inner(f, d), 0);
  }
}

TEST_F(BarsTest, ForcesAreThoseOfTheWholeBarWhateverItsShare) {
  Bar half = list[2], whole = half;
  whole.share = 1;
  const Bars both(X, std::vector{half, whole}, 100, .02, false);
  const auto f = both.forces(x);
  EXPECT_DOUBLE_EQ(f[0], f[1]);
  const double L = norm(minus(place(half.b, X), place(half.a, X))),
               l = norm(minus(place(half.b, x), place(half.a, x)));
  EXPECT_NEAR(f[0], .02 * 100 * (l * l - L * L) / (2 * L * L) * l / L, 1e-12);
}

TEST_F(BarsTest, EmbeddedEndSharesItsForceByItsWeights) {
  const Bars one(X, std::vector{list[1]}, 100, .02, false);
  const auto f = force(one, x);
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(f[3 * list[1].a.nodes[i] + c], -list[1].a.weights[i] * f[3 * 25 + c], 1e-13);
  EXPECT_GT(largest(f), 1e-3);
}

TEST_F(BarsTest, StretchedBarPullsItsEndsTogether) {
  const std::vector<double> Y{0, 0, 0, 2, 0, 0}, y{0, 0, 0, 3, 0, 0};
  const Bars bar(Y, std::vector<Bar>{{at_node(0), at_node(1)}}, 10, .5, false);
  std::vector<double> f(6), reference_force(2);
  bar.add_residual(y, f, reference_force);
  // e = (9 − 4)/8, S = 10 e, force A S |d| / L; the residual is the internal force, outwards
  EXPECT_DOUBLE_EQ(f[3], .5 * 10 * .625 * 1.5);
  EXPECT_DOUBLE_EQ(f[0], -f[3]);
  EXPECT_DOUBLE_EQ(reference_force[0], f[3]);
  EXPECT_DOUBLE_EQ(bar.forces(y)[0], f[3]);
}

TEST_F(BarsTest, TensionOnlyBarsGoSlack) {
  const Bars slack(X, list, 100, .02, true);
  auto small = X;
  for (double& v : small) v *= .8;
  EXPECT_EQ(largest(force(slack, small)), 0);
  EXPECT_LT(bars.forces(small)[0], 0);
  std::vector<double> f(X.size());
  slack.add_stiffness(small, d, f);
  EXPECT_EQ(largest(f), 0);
  auto big = X;
  for (double& v : big) v *= 1.2;
  EXPECT_EQ(force(slack, big), force(bars, big));
}

}  // namespace
}  // namespace bulbus
