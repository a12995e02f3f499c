#pragma once
#include "core/base/pack.hpp"
#include "core/material/convected.hpp"

namespace bulbus::inline material {

/// A neo-Hookean matrix with families of dispersed fibres [Holzapfel, Gasser and Ogden 2000; Gasser, Ogden
/// and Holzapfel 2006]:
///
///     W = c10 (Ī1 − 3) + k1/(2 k2) Σ_i (exp(k2 ⟨E_i⟩²) − 1),   E_i = κ (Ī1 − 3) + (1 − 3κ) (Ī4i − 1)
///
/// ⟨·⟩ is the positive part: fibres bear no compression. κ is 0 for aligned fibres and ⅓ for isotropic ones.
/// The directions belong to hexahedra; FibreLaw is the law with them.
struct FibreReinforced {
  double c10, k1, k2, kappa;
  int families;

  template <class T>
  T shear_modulus(const Sym3<T>&) const {
    return T(2 * c10);
  }
};

/// Strain of a point with fibres: b, and F by which the directions follow; J^(-2/3) F M ⊗ F M is
/// scale · (F M) ⊗ (F M), so that F may be any multiple of the deformation gradient.
template <class T>
struct FibreStrain {
  Sym3<T> b;
  Mat3<T> F;
  T scale;
};

/// The law of one point or pack; `M`: a unit vector in the reference configuration for each family.
///
/// With the structure tensor h = κ b + (1 − 3κ) f ⊗ f of a family, f = J^(-1/3) F M, E is tr h − 1, and h
/// changes as b does. A family is therefore a law of Fung's kind: with ψ = k1/(2 k2) (exp(k2 ⟨E⟩²) − 1) its
/// stress is 2ψ' dev h and its part of the tangent that of 2ψ' h and 4ψ'' (dev h : l) dev h.
template <class T>
struct FibreLaw {
  const FibreReinforced& law;
  const Vec3<T>* M;

  Sym3<T> deviatoric(const FibreStrain<T>& s) const {
    Sym3<T> B = matrix_part(s.b);
    for_each_family(s, [&](const Sym3<T>& h, const Derivatives& d) {
      for (int i = 0; i < 6; ++i) B.v[i] += 2.0 * d.first * h.v[i];
    });
    return deviator(B, T(1.0));
  }

  Mat3<T> tangent(const FibreStrain<T>& s, const Mat3<T>& l, const T& w, const T& p) const {
    Sym3<T> B = matrix_part(s.b), stiffening{};
    const T third = trace(l) * (1.0 / 3);
    for_each_family(s, [&](const Sym3<T>& h, const Derivatives& d) {
      const T rate = 4.0 * d.second * (contract(h, l) - trace(h) * third);  // dev h : l
      for (int i = 0; i < 6; ++i) B.v[i] += 2.0 * d.first * h.v[i], stiffening.v[i] += rate * h.v[i];
    });
    for (T& v : B.v) v *= w;
    Mat3<T> t = convected_tangent(B, l, p);
    add(deviator(stiffening, w), t);
    return t;
  }

  T energy(const FibreStrain<T>& s) const {
    T W = law.c10 * (trace(s.b) - 3.0);
    for_each_family(s, [&](const Sym3<T>&, const Derivatives& d) { W += d.energy; });
    return W;
  }
  /// Of the matrix, and a third of the trace of 2ψ' h of each family.
  T shear_modulus(const FibreStrain<T>& s) const {
    T mu(2 * law.c10);
    for_each_family(s, [&](const Sym3<T>& h, const Derivatives& d) { mu += d.first * trace(h) * (2.0 / 3); });
    return mu;
  }

 private:
  struct Derivatives {
    T energy, first, second;  // ψ, ψ', ψ''
  };

  Sym3<T> matrix_part(Sym3<T> b) const {
    for (T& v : b.v) v *= T(2 * law.c10);
    return b;
  }

  // ψ'' jumps at E = 0, where an unstrained body is up to round-off: fibres count as stretched there, so that
  // the first tangent of a run has them.
  Derivatives derivatives(const T& E) const {
    constexpr double round_off = 1e-10;
    const T stretch = where_above(0, E, E), square = law.k2 * stretch * stretch, e = exponential(square);
    return {(e - 1.0) * (law.k1 / (2 * law.k2)), law.k1 * stretch * e,
            where_above(-round_off, E, T(law.k1 * (1.0 + 2.0 * square) * e))};
  }

  // use(h, ψ and its derivatives)
  template <class Use>
  void for_each_family(const FibreStrain<T>& s, Use use) const {
    for (int i = 0; i < law.families; ++i) {
      Vec3<T> f;
      for (int r = 0; r < 3; ++r) f[r] = s.F(r, 0) * M[i][0] + s.F(r, 1) * M[i][1] + s.F(r, 2) * M[i][2];
      const T aligned = s.scale * (1 - 3 * law.kappa);
      Sym3<T> h;
      for (int r = 0; r < 3; ++r) {
        const T along = aligned * f[r];
        for (int c = r; c < 3; ++c) h(r, c) = law.kappa * s.b(r, c) + along * f[c];
      }
      use(h, derivatives(T(trace(h) - 1.0)));
    }
  }
};

template <class Law>
constexpr bool has_fibres = false;
template <class T>
constexpr bool has_fibres<FibreLaw<T>> = true;

}  // namespace bulbus::inline material
