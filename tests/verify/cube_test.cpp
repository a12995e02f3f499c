// Homogeneous states of a distorted block: the element must give the closed forms to round-off.
#include "tests/support/not_empty.hpp"
#include "tests/verify/homogeneous.hpp"
#include "tests/verify/references.hpp"

namespace bulbus {
namespace {

RegionSpec law(const std::string& material) {
  RegionSpec r;
  r.c10 = material == "nh" ? .0833 : .0633;
  r.c01 = material == "nh" ? 0 : .02;
  return r;
}

class Cube : public testing::TestWithParam<const char*> {
 protected:
  std::vector<ReferenceRow> rows() const {
    std::vector<ReferenceRow> mine;
    for (const auto& r : references("cube_homogeneous.csv"))
      if (r.text("material") == GetParam()) mine.push_back(r);
    EXPECT_EQ(mine.size(), 15u);
    return mine;
  }
  template <class Error>
  void expect_exact(const char* what, Error error) const {
    double worst = 0;
    for (const auto& r : not_empty(rows())) {
      const double e = error(r);
      EXPECT_LT(e, 1e-9) << "lambda = " << r["lambda"];
      worst = worse(worst, e);
    }
    measured("cube, {} {}: largest relative error of the stresses {:.1e} (target 1e-9)", GetParam(), what,
             worst);
  }
};

TEST_P(Cube, Uniaxial) {
  expect_exact("uniaxial", [](const auto& r) {
    return error_of(stretched(law(GetParam()), r["lambda"], {}, {}), diagonal(r["uniaxial_Cauchy"], 0, 0),
                    diagonal(r["uniaxial_nominal"], 0, 0));
  });
}

TEST_P(Cube, Equibiaxial) {
  expect_exact("equibiaxial", [](const auto& r) {
    const double s = r["equibiax_Cauchy"], P = r["equibiax_nominal"];
    return error_of(stretched(law(GetParam()), r["lambda"], r["lambda"], {}), diagonal(s, s, 0),
                    diagonal(P, P, 0));
  });
}

TEST_P(Cube, PureShear) {
  expect_exact("pure shear", [](const auto& r) {
    return error_of(stretched(law(GetParam()), r["lambda"], 1, {}),
                    diagonal(r["pureshear_Cauchy_1"], r["pureshear_Cauchy_2(held)"], 0),
                    diagonal(r["pureshear_nominal_1"], r["pureshear_nominal_2"], 0));
  });
}

TEST_P(Cube, SimpleShear) {
  expect_exact("simple shear", [](const auto& r) {
    const double g = r["simpleshear_gamma"], s12 = r["simpleshear_s12"], s11 = r["simpleshear_s11-s33"],
                 s22 = r["simpleshear_s22-s33"];
    const Mat3<double> cauchy{{{{s11, s12, 0}, {s12, s22, 0}, {0, 0, 0}}}};
    // P = σ F⁻ᵀ, F⁻ᵀ = I − γ e2 ⊗ e1
    const Mat3<double> nominal{{{{s11 - g * s12, s12, 0}, {s12 - g * s22, s22, 0}, {0, 0, 0}}}};
    return error_of(sheared(law(GetParam()), g), cauchy, nominal);
  });
}

INSTANTIATE_TEST_SUITE_P(Materials, Cube, testing::Values("nh", "mr"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace bulbus
