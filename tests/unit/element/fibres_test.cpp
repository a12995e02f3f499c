// Laws that stiffen, in the element: Fung's, and fibres with a direction for each hexahedron.
#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

std::vector<double> random_directions(int count, int seed) {
  std::vector<double> d = noise_vector(3 * count, seed);
  for (int i = 0; i < count; ++i) {
    const double size = norm(at(d, i));
    for (int c = 0; c < 3; ++c) d[3 * i + c] /= size;
  }
  return d;
}

/// 27 hexahedra: 10 of Fung's law, 9 with one family of fibres, 8 with three.
struct StiffTissues : testing::Test {
  FibreReinforced one{.4, .3, .7, 0, 1}, three{.4, .2, .9, .12, 3};
  std::vector<double> of_one = random_directions(9, 21), of_three = random_directions(24, 22);
  Mesh mesh = shaken_block(3, 3, 3);
  std::vector<double> X = places(mesh), x = deformed(X, 7), lambda = noise_vector(27, 5),
                      d = noise_vector(X.size(), 11);
  Solid solid{
      X,
      mesh.hexes,
      {{"fung", Fung{.8, .9}, 0, 10}, {"one", one, 10, 9, of_one}, {"three", three, 19, 8, of_three}}};
  std::optional<SolidTangent> tangent;
  int nodes() const { return static_cast<int>(X.size() / 3); }

  std::vector<double> force(std::span<const double> at) const {
    std::vector<double> f(X.size()), v(27);
    solid.residual(at, lambda, f, v);
    return f;
  }
  void linearise(std::span<const double> at, std::span<const double> pressures, double gamma,
                 StrainSource source = StrainSource::recompute) {
    tangent.emplace(tangent_of(solid, at, pressures, gamma, source));
  }
  std::vector<double> action(std::span<const double> of) const {
    std::vector<double> f(X.size());
    tangent->apply(of, {}, f, {});
    return f;
  }
  template <class Visit>
  std::vector<double> matrix_action(Visit visit) const {
    const BlockCsr A(nodes(), visit);
    std::vector<double> f(X.size());
    A.apply(d, f);
    return f;
  }
};

TEST_F(StiffTissues, ForceIsDerivativeOfTheEnergy) {
  const auto potential = [&](std::span<const double> at) {
    std::vector<double> f(X.size()), v(27);
    solid.residual(at, lambda, f, v);
    return std::vector{solid.energy(at) + inner(lambda, v)};
  };
  const auto f = force(x);
  for (int seed : {1, 2, 3, 4}) {
    const auto e = noise_vector(X.size(), seed);
    EXPECT_NEAR(inner(f, e), derivative(potential, x, e, 1e-4)[0], 1e-8 * std::abs(inner(f, f)));
  }
}

TEST_F(StiffTissues, TangentIsDerivativeOfForce) {
  const auto expected = derivative([&](std::span<const double> at) { return force(at); }, x, d, 1e-4);
  for (StrainSource source : {StrainSource::recompute, StrainSource::cache}) {
    linearise(x, lambda, 0, source);
    EXPECT_LT(relative_difference(action(d), expected), source == StrainSource::cache ? 1e-6 : 1e-8);
  }
}

TEST_F(StiffTissues, TangentIsSymmetric) {
  linearise(x, lambda, 10);
  const auto e = noise_vector(X.size(), 12);
  EXPECT_NEAR(inner(action(d), e), inner(action(e), d), 1e-12 * std::abs(inner(action(d), d)));
}

TEST_F(StiffTissues, ElementMatricesActAsMatrixFree) {
  linearise(x, lambda, 10);
  const auto whole = [&](const ContributionVisitor& v) { tangent->visit(v, true); };
  const auto mean = [&](const ContributionVisitor& v) { tangent->visit_mean(v); };
  EXPECT_LT(relative_difference(matrix_action(whole), action(d)), 1e-13);
  EXPECT_LT(relative_difference(matrix_action(mean), action(d)), .2);
  std::vector<NodeSingle> single(nodes()), force(nodes());
  for (int n = 0; n < nodes(); ++n) single[n] = rounded(&d[3 * n]);
  tangent->apply_single(single, force);
  std::vector<double> f;
  for (const NodeSingle& v : force) f.insert(f.end(), {v[0], v[1], v[2]});
  EXPECT_LT(relative_difference(f, matrix_action(mean)), 2e-6);
}

// Packs of eight give what the law of a point gives, full or not.
TEST_F(StiffTissues, EveryHexahedronHasItsOwnDirections) {
  const Mat3<double> F{{{{1.3, .2, 0}, {-.1, .9, .15}, {.05, 0, .85}}}};
  std::vector<double> y(X.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    for (int c = 0; c < 3; ++c) y[i] += F(i % 3, c) * X[i / 3 * 3 + c];
  const double J = determinant(F), scale = std::pow(J, -2.0 / 3);
  const FibreStrain<double> strain{gram(F, scale), F, scale};
  const auto cells = solid.stresses(y, lambda);
  for (int e = 10; e < 27; ++e) {
    const bool first = e < 19;
    std::vector<Vec3<double>> M;
    for (int i = 0; i < (first ? 1 : 3); ++i)
      M.push_back(first ? at(of_one, e - 10) : at(of_three, 3 * (e - 19) + i));
    const Sym3<double> tau = FibreLaw<double>{first ? one : three, M.data()}.deviatoric(strain);
    for (int c = 0; c < 6; ++c)
      EXPECT_NEAR(cells[e].cauchy.v[c], tau.v[c] / J + (c < 3 ? lambda[e] : 0), 1e-13);
  }
}

TEST_F(StiffTissues, StartWithTheModuliOfTheirMatrices) {
  linearise(X, lambda, 1);
  for (const SolidRegion& r : not_empty(solid.regions()))
    for (int e = r.first; e < r.first + r.count; ++e) EXPECT_NEAR(tangent->shear_moduli()[e], .8, 1e-12);
}

TEST_F(StiffTissues, DirectionsAreNeeded) {
  EXPECT_THROW(Solid(X, mesh.hexes, {{"one", one, 0, 27}}), std::invalid_argument);
}

}  // namespace
}  // namespace bulbus
