#include "core/element/solid_tangent.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

// use(law) of an isotropic law
template <class Use>
auto of_law(const Material& material, Use use) {
  return std::visit(
      [&](const auto& law) -> decltype(use(NeoHooke{})) {
        if constexpr (std::is_same_v<std::decay_t<decltype(law)>, FibreReinforced>)
          throw std::invalid_argument("fibres need directions");
        else
          return use(law);
      },
      material);
}

struct SolidTest : testing::Test, ThreeTissues {
  std::vector<double> d = noise_vector(X.size(), 11);

  std::vector<double> action(std::span<const double> dx, std::span<const double> dlambda = {}) const {
    std::vector<double> f(X.size());
    tangent->apply(dx, dlambda, f, {});
    return f;
  }
  std::vector<double> matrix_action(bool augmented, std::span<const double> dx) const {
    const BlockCsr A(size() / 3, [&](const ContributionVisitor& v) { tangent->visit(v, augmented); });
    std::vector<double> f(X.size());
    A.apply(dx, f);
    return f;
  }
  // Bᵀ v
  std::vector<double> volumes_by_constraints(std::span<const double> v) const {
    std::vector<double> r(27);
    tangent->visit_constraints([&](int hex, std::span<const int> nodes, std::span<const double> b) {
      for (int i = 0; i < 24; ++i) r[hex] += b[i] * v[3 * nodes[i / 3] + i % 3];
    });
    return r;
  }
};

TEST_F(SolidTest, ReferenceVolumesAreTheMeshs) {
  for (int h = 0; h < 27; ++h) EXPECT_NEAR(solid.reference_volumes()[h], hex_volume(mesh, h), 1e-14);
}

TEST_F(SolidTest, ForceIsDerivativeOfEnergyAndConstraint) {
  const auto potential = [&](std::span<const double> at) {
    return std::vector{solid.energy(at) + inner(lambda, volume_defect(at))};
  };
  const auto f = force(x, lambda);
  std::vector<double> expected(X.size());
  for (std::size_t i = 0; i < X.size(); ++i) {
    std::vector<double> e(X.size());
    e[i] = 1;
    expected[i] = derivative(potential, x, e)[0];
  }
  EXPECT_LT(relative_difference(f, expected), 1e-8);
}

TEST_F(SolidTest, VolumeDefectIsVolumeMinusReference) {
  Mesh moved = mesh;
  for (std::size_t i = 0; i < X.size(); ++i) moved.points[i / 3][i % 3] = x[i];
  const auto v = volume_defect(x);
  for (int h = 0; h < 27; ++h) EXPECT_NEAR(v[h], hex_volume(moved, h) - hex_volume(mesh, h), 1e-13);
}

TEST_F(SolidTest, ResidualAddsToForces) {
  std::vector<double> f(X.size(), 1.5), v(27, NAN);
  solid.residual(x, lambda, f, v);
  EXPECT_LT(relative_difference(plus(f, -1, std::vector<double>(X.size(), 1.5)), force(x, lambda)), 1e-14);
  EXPECT_EQ(v, volume_defect(x));
}

TEST_F(SolidTest, MagnitudeBoundsTheNodalForce) {
  std::vector<double> f(X.size()), v(27), reference_force(size() / 3);
  solid.residual(x, lambda, f, v, reference_force);
  for (int n = 0; n < size() / 3; ++n)
    EXPECT_GE(reference_force[n] * (1 + 1e-14), std::hypot(f[3 * n], f[3 * n + 1], f[3 * n + 2]));
  // node 0 has one element: equal
  EXPECT_NEAR(reference_force[0], std::hypot(f[0], f[1], f[2]), 1e-14);
}

TEST_F(SolidTest, TangentIsDerivativeOfForce) {
  for (auto pressures : {std::vector<double>(27), lambda, plus(lambda, 4, lambda)}) {
    linearise(x, pressures, 0);
    const auto expected = derivative([&](std::span<const double> at) { return force(at, pressures); }, x, d);
    EXPECT_LT(relative_difference(action(d), expected), 1e-8);
  }
}

TEST_F(SolidTest, ConstraintIsDerivativeOfVolume) {
  linearise(x, lambda, 0);
  const auto expected = derivative([&](std::span<const double> at) { return volume_defect(at); }, x, d);
  std::vector<double> f(X.size()), from_apply(27, NAN), alone(27, NAN);
  tangent->apply(d, {}, f, from_apply);
  tangent->volume_change(d, alone);
  EXPECT_LT(relative_difference(from_apply, expected), 1e-9);
  EXPECT_LT(relative_difference(alone, from_apply), 1e-14);
  EXPECT_LT(relative_difference(volumes_by_constraints(d), from_apply), 1e-13);
}

TEST_F(SolidTest, PressureForceIsTransposeOfVolumeChange) {
  linearise(x, lambda, 3);
  const auto dl = noise_vector(27, 4);
  std::vector<double> f(X.size()), v(27);
  tangent->apply_pressure(dl, f);
  tangent->volume_change(d, v);
  EXPECT_NEAR(inner(f, d), inner(v, dl), 1e-12);
  EXPECT_LT(relative_difference(plus(action(d, dl), -1, action(d)), f), 1e-12);
}

TEST_F(SolidTest, CacheActsAsRecompute) {
  const auto dl = noise_vector(27, 4);
  linearise(x, lambda, 10);
  const auto exact = action(d, dl);
  EXPECT_EQ(tangent->cache_bytes(), 0u);
  linearise(x, lambda, 10, StrainSource::cache);
  EXPECT_GT(tangent->cache_bytes(), 0u);
  EXPECT_LT(relative_difference(action(d, dl), exact), 1e-6);
}

TEST_F(SolidTest, ElementMatricesActAsMatrixFree) {
  linearise(x, lambda, 0);
  EXPECT_LT(relative_difference(matrix_action(false, d), action(d)), 1e-13);
  linearise(x, lambda, 10);
  EXPECT_LT(relative_difference(matrix_action(true, d), action(d)), 1e-13);
}

TEST_F(SolidTest, ElementMatricesAreSymmetric) {
  linearise(x, lambda, 10);
  tangent->visit(
      [&](std::span<const int>, std::span<const double> K) {
        for (int i = 0; i < 24; ++i)
          for (int j = 0; j < i; ++j) ASSERT_NEAR(K[24 * i + j], K[24 * j + i], 1e-12);
      },
      true);
}

TEST_F(SolidTest, TangentIsLinearAndSymmetric) {
  linearise(x, lambda, 10);
  const auto e = noise_vector(X.size(), 12);
  const auto sum = action(plus(d, -2.5, e)), parts = plus(action(d), -2.5, action(e));
  EXPECT_LT(relative_difference(sum, parts), 1e-13);
  EXPECT_NEAR(inner(action(d), e), inner(action(e), d), 1e-10);
}

TEST_F(SolidTest, AugmentationIsExactlyGammaMuOverVolumeTimesBB) {
  const double gamma = 10;
  linearise(x, lambda, 0);
  auto expected = action(d);
  auto weighted = volumes_by_constraints(d);
  linearise(x, lambda, gamma);
  for (int e = 0; e < 27; ++e) {
    EXPECT_DOUBLE_EQ(tangent->penalties()[e],
                     gamma * tangent->shear_moduli()[e] / solid.reference_volumes()[e]);
    weighted[e] *= tangent->penalties()[e];
  }
  tangent->apply_pressure(weighted, expected);
  EXPECT_LT(relative_difference(action(d), expected), 1e-13);
}

TEST_F(SolidTest, TangentsOfTwoStatesStayWhatTheyAre) {
  linearise(X, lambda, 10, StrainSource::cache);
  const auto of_first = action(d);
  const SolidTangent first = *tangent;
  linearise(x, lambda, 10, StrainSource::cache);
  std::vector<double> f(X.size());
  first.apply(d, {}, f, {});
  EXPECT_EQ(f, of_first);
  EXPECT_GT(relative_difference(action(d), of_first), 1e-2);
}

TEST_F(SolidTest, UnaugmentedMatricesIgnoreGamma) {
  linearise(x, lambda, 0);
  const auto plain = action(d);
  linearise(x, lambda, 10);
  EXPECT_LT(relative_difference(matrix_action(false, d), plain), 1e-13);
}

TEST_F(SolidTest, ShearModuliStartFromTheInitialOnes) {
  linearise(X, lambda, 1);
  for (const SolidRegion& r : not_empty(solid.regions()))
    for (int e = r.first; e < r.first + r.count; ++e)
      EXPECT_NEAR(tangent->shear_moduli()[e], initial_shear_modulus(r.material), 1e-13);
}

TEST_F(SolidTest, ShearModuliAreFlooredAtATenth) {
  // softens: 2 (c10 + 2 c20 (I1 - 3)) falls below zero under strain
  Solid soft(X, mesh.hexes, {{"soft", make_material({{1, 0, 1}, {2, 0, -50}}), 0, 27}});
  const SolidTangent tangent = tangent_of(soft, x, lambda, 1);
  for (double mu : not_empty(tangent.shear_moduli())) EXPECT_DOUBLE_EQ(mu, 0.2);
}

TEST_F(SolidTest, RigidMotionsGiveNoDeviatoricForce) {
  Mat3<double> R{{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
  std::vector<double> turned(X.size());
  for (int n = 0; n < size() / 3; ++n)
    for (int c = 0; c < 3; ++c)
      turned[3 * n + c] = 5 + R(c, 0) * X[3 * n] + R(c, 1) * X[3 * n + 1] + R(c, 2) * X[3 * n + 2];
  EXPECT_LT(largest(force(turned, std::vector<double>(27))), 1e-13);
  EXPECT_NEAR(solid.energy(turned), 0, 1e-13);
  EXPECT_NEAR(solid.least_jacobian(turned), 1, 1e-13);
}

TEST_F(SolidTest, LeastJacobianNamesTheInvertedHexahedron) {
  for (int hex : {0, 9, 12, 26}) {
    auto bent = X;
    const Hex& h = mesh.hexes[hex];
    // push one corner of this hexahedron through it; the corner is its own only at hex 0 and 26
    const int corner = hex == 0 ? h[0] : hex == 26 ? h[6] : -1;
    if (corner >= 0) {
      const Point c = center(mesh, hex);
      for (int k = 0; k < 3; ++k) bent[3 * corner + k] += 2.2 * (c[k] - X[3 * corner + k]);
      int found = -1;
      EXPECT_LT(solid.least_jacobian(bent, &found), 0);
      EXPECT_EQ(found, hex);
    } else {
      EXPECT_GT(solid.least_jacobian(bent), 0);
    }
  }
}

TEST_F(SolidTest, LeastJacobianOfNanIsInverted) {
  auto bad = x;
  bad[3 * mesh.hexes[26][6]] = NAN;
  int hex = -1;
  EXPECT_FALSE(solid.least_jacobian(bad, &hex) > 0);
  EXPECT_EQ(hex, 26);
}

TEST_F(SolidTest, HomogeneousDeformationHasItsExactStress) {
  const Mat3<double> F{{{{1.3, .2, 0}, {-.1, .9, .15}, {.05, 0, .85}}}};
  std::vector<double> y(X.size());
  for (int n = 0; n < size() / 3; ++n)
    for (int c = 0; c < 3; ++c)
      y[3 * n + c] = F(c, 0) * X[3 * n] + F(c, 1) * X[3 * n + 1] + F(c, 2) * X[3 * n + 2];
  const double J = determinant(F);
  const Sym3<double> b = gram(F, std::pow(J, -2.0 / 3));
  const auto cells = solid.stresses(y, lambda);
  for (const SolidRegion& r : not_empty(solid.regions())) {
    const Sym3<double> tau = of_law(r.material, [&](const auto& m) { return m.deviatoric(b); });
    for (int e = r.first; e < r.first + r.count; ++e) {
      for (int c = 0; c < 6; ++c)
        EXPECT_NEAR(cells[e].cauchy.v[c], tau.v[c] / J + (c < 3 ? lambda[e] : 0), 1e-13);
      EXPECT_NEAR(cells[e].mises, std::sqrt(1.5 * contract(tau, tau)) / J, 1e-13);
    }
  }
}

TEST_F(SolidTest, EnergyOfHomogeneousDeformationIsDensityTimesVolume) {
  const double s = 1.4;
  std::vector<double> y(X);
  for (int n = 0; n < size() / 3; ++n)
    y[3 * n] *= s, y[3 * n + 1] /= std::sqrt(s), y[3 * n + 2] /= std::sqrt(s);
  const Sym3<double> b{{s * s, 1 / s, 1 / s, 0, 0, 0}};
  double expected = 0;
  for (const SolidRegion& r : solid.regions())
    for (int e = r.first; e < r.first + r.count; ++e)
      expected +=
          solid.reference_volumes()[e] * of_law(r.material, [&](const auto& m) { return m.energy(b); });
  EXPECT_NEAR(solid.energy(y), expected, 1e-12 * expected);
}

TEST(Solid, FewerHexahedraThanLanes) {
  for (int n : {1, 3, 7, 8, 9, 16, 17, 25}) {
    Row row{n};
    auto& [count, mesh, X, x, lambda, d, solid] = row;
    const SolidTangent tangent = tangent_of(solid, x, lambda, 0, StrainSource::cache);
    const auto f = [&row](std::span<const double> at) {
      std::vector<double> out(row.X.size()), v(row.n);
      row.solid.residual(at, row.lambda, out, v);
      return out;
    };
    std::vector<double> action(X.size()), v(n, NAN);
    tangent.apply(d, {}, action, v);
    EXPECT_LT(relative_difference(action, derivative(f, x, d)), 2e-6) << n;
    EXPECT_TRUE(std::isfinite(largest(v)));
  }
}

TEST(Solid, NoHexahedraAtAll) {
  Solid solid({}, {}, {{"a", make_material({{1, 0, .8}}), 0, 0}});
  EXPECT_EQ(solid.hexes(), 0);
  EXPECT_EQ(solid.least_jacobian({}), std::numeric_limits<double>::infinity());
}

TEST(BlockCsr, HoldsOneBlockPerPairOfNeighbours) {
  const Mesh mesh = shaken_block(2, 1, 1);
  const auto X = places(mesh);
  const std::vector<double> lambda(2);
  Solid solid(X, mesh.hexes, {{"a", make_material({{1, 0, .8}}), 0, 2}});
  const SolidTangent tangent = tangent_of(solid, X, lambda, 0);
  const BlockCsr A(12, [&](const ContributionVisitor& v) { tangent.visit(v, false); });
  EXPECT_EQ(A.nonzeros(), 9u * (2 * 64 - 16));
  EXPECT_EQ(A.starts().back(), 2 * 64 - 16);
  for (int n = 0; n < 12; ++n)
    EXPECT_TRUE(std::is_sorted(A.columns().begin() + A.starts()[n], A.columns().begin() + A.starts()[n + 1]));
}

}  // namespace
}  // namespace bulbus
