#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/parameters.hpp"

namespace bulbus::inline problem {

/// W = a/(2b) (exp(b (Ī1 − 3)) − 1), Fung-Demiray.
struct FungSpec {
  double a = 1, b = 1;
  template <class V>
  void describe(V&& v) {
    v("a", a, About{"initial shear modulus", Quantity::stress}.needed().positive());
    v("b", b, About{"rate at which it stiffens"}.needed().positive());
  }
};

/// The directions of one family of fibres in the reference configuration.
struct FibreFamilySpec {
  std::optional<std::vector<std::string>> direction;
  std::optional<double> angle;
  Point axis{0, 0, 1}, center{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("direction", direction,
      About{"three formulas in X, Y, Z (mm), the middle of a hexahedron: a vector of any length along the "
            "fibres"}
          .expression());
    v("angle", angle,
      About{"instead: the angle to the circles about `axis`, in spheres about `center`; 0 along the circles, "
            "90 "
            "deg along the meridians",
            Quantity::angle}
          .between(-3.1416, 3.1416));
    v("axis", axis, About{"direction of the axis of circles and meridians, which passes through `center`"});
    v("center", center, About{"centre of the spheres that circles and meridians lie on", Quantity::length});
  }
};

/// k1/(2 k2) Σ_i (exp(k2 ⟨E_i⟩²) − 1) with E_i = κ (Ī1 − 3) + (1 − 3κ)(Ī4i − 1), beside c10 (Ī1 − 3):
/// Holzapfel-Gasser-Ogden.
struct FibresSpec {
  double k1 = 1, k2 = 1, dispersion = 0;
  std::vector<FibreFamilySpec> families;
  template <class V>
  void describe(V&& v) {
    v("k1", k1, About{"stiffness of the fibres", Quantity::stress}.needed().positive());
    v("k2", k2, About{"rate at which they stiffen"}.needed().positive());
    v("dispersion", dispersion,
      About{"kappa: 0 where the fibres of a family are parallel, 1/3 where they have no direction"}.between(
          0, 1. / 3));
    v("families", families, About{"one entry for each family of fibres"}.needed());
  }
};

}  // namespace bulbus::inline problem
