#pragma once
#include "core/base/pack.hpp"
#include "core/material/convected.hpp"

namespace bulbus::inline material {

/// W = a/(2b) (exp(b (Ī1 − 3)) − 1) [Demiray 1972], the isotropic law of Fung's kind: a is the initial shear
/// modulus (MPa), b the rate of stiffening. Where the exponential overflows, stress and energy are infinite.
struct Fung {
  double a, b;

  template <class T>
  Sym3<T> deviatoric(const Sym3<T>& left) const {
    return deviator(left, shear_modulus(left));
  }

  /// With 4 W11 = 2b · 2W1 and δĪ1 = 2 dev b : l, δτ has the part 4 W11 (dev b : l) dev b beside that of b.
  template <class T>
  Mat3<T> tangent(Sym3<T> left, const Mat3<T>& l, const T& w, const T& p) const {
    const T weight = shear_modulus(left) * w;
    Sym3<T> dev = deviator(left, T(1.0));
    const T rate = 2 * b * weight * contract(dev, l);
    for (T& v : dev.v) v *= rate;
    for (T& v : left.v) v *= weight;
    Mat3<T> t = convected_tangent(left, l, p);
    add(dev, t);
    return t;
  }

  template <class T>
  T energy(const Sym3<T>& left) const {
    return (shear_modulus(left) - a) * (0.5 / b);
  }
  /// 2 W1
  template <class T>
  T shear_modulus(const Sym3<T>& left) const {
    return a * exponential(T(b * (trace(left) - 3.0)));
  }
};

}  // namespace bulbus::inline material
