#pragma once
#include <variant>
#include <vector>

#include "core/material/convected.hpp"
#include "core/material/fibres.hpp"
#include "core/material/fung.hpp"

namespace bulbus::inline material {

/// Isochoric hyperelasticity as pointwise mathematics in the current frame, on doubles or packs alike.
///
/// With b the isochoric left Cauchy-Green tensor J^(-2/3) F Fᵀ (so Ī1 = tr b, Ī2 = ½(Ī1² − b:b)) and m = Ī1 b
/// − b²:
///
///     τ = 2 W1 dev b + 2 W2 dev m          deviatoric Kirchhoff stress
///     T(l) = δτ − τ lᵀ                     its change under δx with l = ∇ₓδx, ready for ∫ T : ∇ₓv dV0
///     δb = l b + b lᵀ − ⅔ tr(l) b
///
/// The element adds λJ I to τ and λJ (tr(l) I − lᵀ) to T. Every material offers deviatoric(b), energy(b),
/// shear_modulus(b) = 2 (W1 + W2) and tangent(b, l, w, p) = w T(l) + p (tr(l) I − lᵀ): folding the weight and
/// the pressure part in saves a tenth of the operations of an application.

/// W = c10 (Ī1 − 3)
struct NeoHooke {
  double c10;

  template <class T>
  Sym3<T> deviatoric(const Sym3<T>& b) const {
    return deviator(b, T(2 * c10));
  }

  template <class T>
  Mat3<T> tangent(Sym3<T> b, const Mat3<T>& l, const T& w, const T& p) const {
    const T weight = 2 * c10 * w;
    for (T& v : b.v) v *= weight;
    return convected_tangent(b, l, p);
  }

  template <class T>
  T energy(const Sym3<T>& b) const {
    return c10 * (trace(b) - 3.0);
  }
  template <class T>
  T shear_modulus(const Sym3<T>&) const {
    return T(2 * c10);
  }
};

/// First and second derivatives of W at a point.
template <class T>
struct Derivatives {
  T w, w1, w2, w11, w12, w22;
};

/// W = Σ c_rs (Ī1 − 3)^r (Ī2 − 3)^s
struct Polynomial {
  struct Term {
    int r, s;
    double c;
  };
  std::vector<Term> terms;

  template <class T>
  Derivatives<T> at(const T& I1, const T& I2) const {
    Derivatives<T> d{T(0.), T(0.), T(0.), T(0.), T(0.), T(0.)};
    const T x = I1 - 3.0, y = I2 - 3.0;
    for (const auto& [r, s, c] : terms) {
      d.w += c * power(x, r) * power(y, s);
      if (r > 0) d.w1 += c * r * power(x, r - 1) * power(y, s);
      if (s > 0) d.w2 += c * s * power(x, r) * power(y, s - 1);
      if (r > 1) d.w11 += c * r * (r - 1) * power(x, r - 2) * power(y, s);
      if (s > 1) d.w22 += c * s * (s - 1) * power(x, r) * power(y, s - 2);
      if (r > 0 && s > 0) d.w12 += c * r * s * power(x, r - 1) * power(y, s - 1);
    }
    return d;
  }

 private:
  template <class T>
  static T power(const T& x, int n) {
    T p(1.0);
    for (int i = 0; i < n; ++i) p *= x;
    return p;
  }
};

/// W = c10 (Ī1 − 3) + c01 (Ī2 − 3)
struct MooneyRivlin {
  double c10, c01;

  template <class T>
  Derivatives<T> at(const T& I1, const T& I2) const {
    return {c10 * (I1 - 3.0) + c01 * (I2 - 3.0), T(c10), T(c01), T(0.), T(0.), T(0.)};
  }
};

/// Stress and tangent from the derivatives of W, for every energy that knows Ī2.
template <class Energy>
struct Isotropic {
  Energy W;

  template <class T>
  Sym3<T> deviatoric(const Sym3<T>& b) const {
    const Point<T> p(b);
    const Derivatives<T> d = W.at(p.I1, p.I2);
    return combine(deviator(b, T(2 * d.w1)), deviator(p.m, T(2 * d.w2)));
  }

  template <class T>
  Mat3<T> tangent(const Sym3<T>& b, const Mat3<T>& l, const T& w, const T& p) const {
    const Point<T> point(b);
    const Derivatives<T> d = W.at(point.I1, point.I2);
    const Sym3<T> db = rate(b, l);
    const T dI1 = trace(db), dI2 = point.I1 * dI1 - contract(b, db);
    const Sym3<T> dm = rate_of_m(b, db, point.I1, dI1);
    const T dW1 = d.w11 * dI1 + d.w12 * dI2, dW2 = d.w12 * dI1 + d.w22 * dI2;
    Sym3<T> dtau, tau;
    for (int i = 0; i < 6; ++i) {
      tau.v[i] = 2.0 * (d.w1 * b.v[i] + d.w2 * point.m.v[i]);
      dtau.v[i] = 2.0 * (d.w1 * db.v[i] + d.w2 * dm.v[i] + dW1 * b.v[i] + dW2 * point.m.v[i]);
    }
    dtau = deviator(dtau, T(1.0));
    tau = deviator(tau, T(1.0));
    Mat3<T> t;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        t(i, j) = w * (dtau(i, j) - (tau(i, 0) * l(j, 0) + tau(i, 1) * l(j, 1) + tau(i, 2) * l(j, 2))) -
                  p * l(j, i);
      t(i, i) += p * trace(l);
    }
    return t;
  }

  template <class T>
  T energy(const Sym3<T>& b) const {
    const Point<T> p(b);
    return W.at(p.I1, p.I2).w;
  }
  template <class T>
  T shear_modulus(const Sym3<T>& b) const {
    const Point<T> p(b);
    const Derivatives<T> d = W.at(p.I1, p.I2);
    return 2.0 * (d.w1 + d.w2);
  }

 private:
  template <class T>
  struct Point {
    T I1, I2;
    Sym3<T> m;  // Ī1 b − b²
    explicit Point(const Sym3<T>& b) : I1(trace(b)), m(square(b)) {
      I2 = 0.5 * (I1 * I1 - trace(m));
      for (int i = 0; i < 6; ++i) m.v[i] = I1 * b.v[i] - m.v[i];
    }
  };

  template <class T>
  static Sym3<T> combine(Sym3<T> a, const Sym3<T>& b) {
    for (int i = 0; i < 6; ++i) a.v[i] += b.v[i];
    return a;
  }

  // δb = l b + b lᵀ − ⅔ tr(l) b
  template <class T>
  static Sym3<T> rate(const Sym3<T>& b, const Mat3<T>& l) {
    const Mat3<T> lb = l * b;
    const T expansion = trace(l) * (2.0 / 3);
    Sym3<T> r;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) r(i, j) = lb(i, j) + lb(j, i) - expansion * b(i, j);
    return r;
  }

  // δm = δĪ1 b + Ī1 δb − δb b − b δb
  template <class T>
  static Sym3<T> rate_of_m(const Sym3<T>& b, const Sym3<T>& db, const T& I1, const T& dI1) {
    Sym3<T> r;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        T product = dI1 * b(i, j) + I1 * db(i, j);
        for (int k = 0; k < 3; ++k) product -= db(i, k) * b(k, j) + b(i, k) * db(k, j);
        r(i, j) = product;
      }
    return r;
  }
};

using Material =
    std::variant<NeoHooke, Isotropic<MooneyRivlin>, Isotropic<Polynomial>, Fung, FibreReinforced>;

/// The leanest material for the given terms: neo-Hookean regions run no Ī2 code.
Material make_material(const std::vector<Polynomial::Term>& terms);

/// 2 (W1 + W2) in the undeformed state: the small-strain shear modulus. Fibres, which carry nothing there,
/// have no part in it.
double initial_shear_modulus(const Material& material);

/// Is W a polynomial of Ī1 and Ī2, which its terms say all of?
bool is_polynomial(const Material& material);

/// Is the law stable in every state by its form (see core/problem/material_stability)? Its energy is then a
/// rising convex function of Σ e^(2ε), ε the logarithmic stretches.
bool always_stable(const Material& material);

}  // namespace bulbus::inline material
