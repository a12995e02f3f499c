#pragma once
#include "core/base/tensor.hpp"

namespace bulbus::inline material {

template <class T>
Sym3<T> deviator(Sym3<T> a, const T& factor) {
  const T mean = trace(a) * (1.0 / 3);
  for (int i = 0; i < 3; ++i) a.v[i] = factor * (a.v[i] - mean);
  for (int i = 3; i < 6; ++i) a.v[i] = factor * a.v[i];
  return a;
}

/// T of the stress dev B of a tensor that is carried along, δB = l B + B lᵀ − ⅔ tr(l) B, and p (tr(l) I −
/// lᵀ):
///
///     T = l B − ⅔ (B:l) I + ⅓ tr B lᵀ − ⅔ tr l B + 2/9 tr B tr l I
///
/// With e = ⅔ tr l and q = (l − e I) B, whose trace is B:l − e tr B, this is q + ⅓ tr B lᵀ − ⅔ tr q I − ⅓ e
/// tr B I.
template <class T>
Mat3<T> convected_tangent(const Sym3<T>& B, const Mat3<T>& l, const T& p) {
  const T third = trace(B) * (1.0 / 3), tr = trace(l), e = tr * (2.0 / 3), transposed = third - p;
  Mat3<T> t = l;
  for (int i = 0; i < 3; ++i) t(i, i) -= e;
  t = t * B;
  const T spherical = p * tr - third * e - trace(t) * (2.0 / 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t(i, j) += transposed * l(j, i);
    t(i, i) += spherical;
  }
  return t;
}

/// t += S
template <class T>
void add(const Sym3<T>& S, Mat3<T>& t) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) += S(i, j);
}

}  // namespace bulbus::inline material
