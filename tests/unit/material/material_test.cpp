#include "core/material/material.hpp"

#include <gtest/gtest.h>

#include "core/base/pack.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

using Terms = std::vector<Polynomial::Term>;

Sym3<double> isochoric(const Mat3<double>& F) { return gram(F, std::pow(determinant(F), -2.0 / 3)); }

Mat3<double> inverse(const Mat3<double>& a) {
  const Mat3<double> c = cofactor(a);
  const double det = determinant(a, c);
  Mat3<double> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = c(j, i) / det;
  return r;
}

Mat3<double> transposed(const Mat3<double>& a) {
  Mat3<double> t;
  for (int i = 0; i < 9; ++i) t(i / 3, i % 3) = a(i % 3, i / 3);
  return t;
}

std::vector<double> flat(const Mat3<double>& m) {
  std::vector<double> v;
  for (int i = 0; i < 9; ++i) v.push_back(m(i / 3, i % 3));
  return v;
}
std::vector<double> flat(const Sym3<double>& m) {
  std::vector<double> v;
  for (int i = 0; i < 9; ++i) v.push_back(m(i / 3, i % 3));
  return v;
}
Mat3<double> matrix(std::span<const double> v) {
  Mat3<double> m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = v[i];
  return m;
}

const Terms full{{1, 0, .7}, {0, 1, .3}, {2, 0, .4}, {1, 1, .5}, {0, 2, .6}, {3, 0, .2}};

/// Deformation gradients about and far from the identity.
std::vector<Mat3<double>> states() {
  std::vector<Mat3<double>> all{random_gradient(1, 0)};
  for (int i = 2; i < 8; ++i) {
    Mat3<double> F = random_gradient(i, 0.4);
    if (determinant(F) > 0.1) all.push_back(F);
  }
  return all;
}

template <class M>
Sym3<double> strain_of(const M&, const Mat3<double>& F) {
  return isochoric(F);
}
FibreStrain<double> strain_of(const FibreLaw<double>&, const Mat3<double>& F) {
  return {isochoric(F), F, std::pow(determinant(F), -2.0 / 3)};
}

template <class M>
std::vector<double> difference_tangent(const M& material, const Mat3<double>& F, const Mat3<double>& l) {
  const auto tau = [&](std::span<const double> f) {
    return flat(material.deviatoric(strain_of(material, matrix(f))));
  };
  const Mat3<double> t = matrix(derivative(tau, flat(F), flat(l * F), 1e-4));
  return plus(flat(t), -1, flat(matrix(flat(material.deviatoric(strain_of(material, F)))) * transposed(l)));
}

template <class M>
void expect_consistent(const M& material, const std::vector<Mat3<double>>& at = states()) {
  int seed = 100;
  for (const Mat3<double>& F : at) {
    const Mat3<double> l = random_matrix(++seed);
    const auto b = strain_of(material, F);
    EXPECT_LT(relative_difference(flat(material.tangent(b, l, 1., 0.)), difference_tangent(material, F, l)),
              1e-8);
    const auto energy = [&](std::span<const double> f) {
      return std::vector{material.energy(strain_of(material, matrix(f)))};
    };
    const double change = derivative(energy, flat(F), flat(l * F))[0];
    EXPECT_NEAR(contract(material.deviatoric(b), l), change, 1e-9 * (1 + std::abs(change)));
    EXPECT_NEAR(trace(material.deviatoric(b)), 0, 1e-13 * (1 + largest(flat(material.deviatoric(b)))));
  }
}

TEST(Material, NeoHookeStressAndTangentAreDerivatives) { expect_consistent(NeoHooke{.8}); }
TEST(Material, MooneyRivlinStressAndTangentAreDerivatives) {
  expect_consistent(Isotropic<MooneyRivlin>{{.8, .35}});
}
TEST(Material, PolynomialStressAndTangentAreDerivatives) { expect_consistent(Isotropic<Polynomial>{{full}}); }

TEST(Material, FungStressAndTangentAreDerivatives) { expect_consistent(Fung{.8, .9}); }

/// Two families, and their law.
struct Families {
  FibreReinforced law{.4, .3, .7, .1, 2};
  std::array<Vec3<double>, 2> M{Vec3<double>{.6, .8, 0}, Vec3<double>{0, .28, .96}};
  FibreLaw<double> with() const { return {law, M.data()}; }
};

TEST(Material, FibreStressAndTangentAreDerivatives) {
  Families f;
  auto strained = states();
  strained.erase(strained.begin());  // unstrained fibres have a tangent to either side
  expect_consistent(f.with(), strained);
  f.law.kappa = 0;
  expect_consistent(f.with(), strained);
}

// κ = ⅓: W = c10 (Ī1 − 3) + N k1/(2 k2) (exp(k2 (Ī1 − 3)²/9) − 1)
TEST(Material, FibresWithoutDirectionAreIsotropic) {
  Families f;
  f.law.kappa = 1. / 3;
  for (const Mat3<double>& F : states()) {
    const Sym3<double> b = isochoric(F);
    const double E = (trace(b) - 3) / 3, W1 = .4 + 2 * .3 / 3 * E * std::exp(.7 * E * E);
    EXPECT_LT(largest(plus(flat(f.with().deviatoric(strain_of(f.with(), F))), -1, flat(deviator(b, 2 * W1)))),
              1e-13 * W1 * trace(b));
  }
}

TEST(Material, CompressedFibresBearNothing) {
  Families f;
  f.law.kappa = 0;
  Mat3<double> F{{{{.8, 0, 0}, {0, .7, 0}, {0, 0, 1}}}};
  f.M[1] = {0, 1, 0};
  EXPECT_LT(relative_difference(flat(f.with().deviatoric(strain_of(f.with(), F))),
                                flat(NeoHooke{.4}.deviatoric(isochoric(F)))),
            1e-15);
}

TEST(Material, InfiniteStressWhereTheExponentialOverflows) {
  const Sym3<double> b{{900, 1. / 30, 1. / 30, 0, 0, 0}};
  EXPECT_FALSE(std::isfinite(Fung{1, 1}.deviatoric(b).v[0]));
}

TEST(Material, NeoHookeClosedFormIsThePolynomialsTangent) {
  const Isotropic<Polynomial> general{{Terms{{1, 0, .8}}}};
  for (const Mat3<double>& F : states()) {
    const Sym3<double> b = isochoric(F);
    const Mat3<double> l = random_matrix(11);
    EXPECT_LT(
        relative_difference(flat(NeoHooke{.8}.tangent(b, l, 1., 0.)), flat(general.tangent(b, l, 1., 0.))),
        1e-14);
    EXPECT_LT(largest(plus(flat(NeoHooke{.8}.deviatoric(b)), -1, flat(general.deviatoric(b)))), 1e-14);
  }
}

TEST(Material, MooneyRivlinIsThePolynomials) {
  const Isotropic<Polynomial> general{{Terms{{1, 0, .8}, {0, 1, .35}}}};
  const Isotropic<MooneyRivlin> special{{.8, .35}};
  for (const Mat3<double>& F : states()) {
    const Sym3<double> b = isochoric(F);
    const Mat3<double> l = random_matrix(12);
    EXPECT_LT(relative_difference(flat(special.tangent(b, l, 1., 0.)), flat(general.tangent(b, l, 1., 0.))),
              1e-14);
    EXPECT_NEAR(special.energy(b), general.energy(b), 1e-14);
    EXPECT_NEAR(special.shear_modulus(b), general.shear_modulus(b), 1e-14);
  }
}

TEST(Material, EnergyVanishesUndeformed) {
  const Sym3<double> b{{1, 1, 1, 0, 0, 0}};
  EXPECT_EQ(NeoHooke{.8}.energy(b), 0);
  EXPECT_EQ((Isotropic<Polynomial>{{full}}.energy(b)), 0);
  EXPECT_EQ((Fung{.8, 5}.energy(b)), 0);
}

// formulation.md, section 1, with λ = 0
TEST(Material, AgreesWithSecondPiolaStress) {
  const Isotropic<Polynomial> material{{full}};
  for (const Mat3<double>& F : states()) {
    const Mat3<double> C = transposed(F) * F, Ci = inverse(C), C2 = C * C;
    const double J = determinant(F), I1 = trace(C), I2 = .5 * (I1 * I1 - trace(C2));
    const double x = std::pow(J, -2.0 / 3) * I1 - 3, y = std::pow(J, -4.0 / 3) * I2 - 3;
    const double W1 = .7 + .8 * x + .5 * y + .6 * x * x, W2 = .3 + .5 * x + 1.2 * y;
    Mat3<double> S;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        S(i, j) = 2 * W1 * std::pow(J, -2.0 / 3) * ((i == j) - I1 / 3 * Ci(i, j)) +
                  2 * W2 * std::pow(J, -4.0 / 3) * (I1 * (i == j) - C(i, j) - 2.0 / 3 * I2 * Ci(i, j));
    EXPECT_LT(largest(plus(flat(F * S * transposed(F)), -1, flat(material.deviatoric(isochoric(F))))), 1e-12);
  }
}

TEST(Material, TangentIsSymmetricInItsDirections) {
  const Isotropic<Polynomial> material{{full}};
  const Sym3<double> b = isochoric(random_gradient(3, .4));
  const Mat3<double> l = random_matrix(21), m = random_matrix(22);
  EXPECT_NEAR(inner(flat(material.tangent(b, l, 1., 0.)), flat(m)),
              inner(flat(material.tangent(b, m, 1., 0.)), flat(l)), 1e-12);
}

template <class M>
void expect_packs_as_doubles(const M& material) {
  Sym3<Pack> b;
  Mat3<Pack> l;
  std::array<Sym3<double>, lanes> bs;
  for (int k = 0; k < lanes; ++k) bs[k] = isochoric(random_gradient(30 + k, .3));
  for (int i = 0; i < 6; ++i) {
    double v[lanes];
    for (int k = 0; k < lanes; ++k) v[k] = bs[k].v[i];
    b.v[i] = load(v);
  }
  const Mat3<double> one = random_matrix(23);
  for (int i = 0; i < 9; ++i) l(i / 3, i % 3) = one(i / 3, i % 3);
  const Mat3<Pack> t = material.tangent(b, l, Pack(1.), Pack(0.));
  for (int k = 0; k < lanes; ++k) {
    const Mat3<double> expected = material.tangent(bs[k], one, 1., 0.);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(t(i / 3, i % 3)[k], expected(i / 3, i % 3), 1e-12);
  }
}

TEST(Material, PacksComputeWhatDoublesDo) {
  expect_packs_as_doubles(NeoHooke{.8});
  expect_packs_as_doubles(Isotropic<MooneyRivlin>{{.8, .35}});
  expect_packs_as_doubles(Isotropic<Polynomial>{{full}});
  expect_packs_as_doubles(Fung{.8, .9});
}

TEST(Material, OnlyLawsThatAreStableSaySo) {
  EXPECT_TRUE(always_stable(make_material({{1, 0, 2}})));
  EXPECT_TRUE(always_stable(Fung{1, 2}));
  EXPECT_FALSE(always_stable(make_material({{1, 0, 2}, {2, 0, -1}})));
}

TEST(Material, OnlyPolynomialsAreSaidByTheirTerms) {
  for (const Terms& terms : {Terms{{1, 0, 2}}, {{1, 0, 2}, {0, 1, 1}}, {{1, 0, 2}, {0, 2, 1}}})
    EXPECT_TRUE(is_polynomial(make_material(terms)));
  EXPECT_FALSE(is_polynomial(Fung{1, 2}));
  EXPECT_FALSE(is_polynomial(FibreReinforced{.4, 3, 7, 0, 2}));
}

TEST(MakeMaterial, PicksTheLeanest) {
  EXPECT_TRUE(std::holds_alternative<NeoHooke>(make_material({{1, 0, 2}})));
  EXPECT_TRUE(std::holds_alternative<NeoHooke>(make_material({{1, 0, 2}, {0, 1, 0}, {2, 0, 0}})));
  EXPECT_TRUE(std::holds_alternative<Isotropic<MooneyRivlin>>(make_material({{1, 0, 2}, {0, 1, 1}})));
  EXPECT_TRUE(std::holds_alternative<Isotropic<Polynomial>>(make_material({{1, 0, 2}, {0, 2, 1}})));
}

TEST(MakeMaterial, AddsRepeatedTerms) {
  EXPECT_DOUBLE_EQ(initial_shear_modulus(make_material({{1, 0, 2}, {1, 0, 3}})), 10);
  EXPECT_DOUBLE_EQ(initial_shear_modulus(make_material({{1, 0, 2}, {0, 1, 1}})), 6);
  EXPECT_DOUBLE_EQ(initial_shear_modulus(Fung{.7, 20}), .7);
  EXPECT_DOUBLE_EQ(initial_shear_modulus(FibreReinforced{.4, 3, 7, 0, 2}), .8);
  EXPECT_DOUBLE_EQ(initial_shear_modulus(make_material({{1, 0, 2}, {0, 1, 1}, {2, 0, 7}})), 6);
}

}  // namespace
}  // namespace bulbus
