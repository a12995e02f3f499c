#include "contact/pair.hpp"

namespace bulbus {

Pair project(const Vec3<double>& x, const Triangle& corners) {
  const Vec3<double> e1 = minus(corners[1], corners[0]), e2 = minus(corners[2], corners[0]), r = minus(x, corners[0]);
  Vec3<double> n = cross(e1, e2);
  const double j = norm(n);
  for (double& v : n) v /= j;
  Vec3<double> t1 = cross(e2, n), t2 = cross(n, e1);
  for (double& v : t1) v /= j;
  for (double& v : t2) v /= j;
  const double L2 = dot(t1, r), L3 = dot(t2, r);
  return {dot(r, n), n, {1 - L2 - L3, L2, L3}, {t1, t2}};
}

std::array<double, 12> gradient(const Pair& p) {
  std::array<double, 12> D;
  for (int c = 0; c < 3; ++c) {
    D[c] = p.normal[c];
    for (int i = 0; i < 3; ++i) D[3 + 3 * i + c] = -p.weights[i] * p.normal[c];
  }
  return D;
}

// H = −Σ_β (T_β N_βᵀ + N_β T_βᵀ) − G Σ_βγ m^βγ N_β N_γᵀ
//   = −Σ_β (S_β N_βᵀ + N_β S_βᵀ)  with  S_β = T_β + ½ G Σ_γ m^βγ N_γ
std::array<double, 144> tangent(const Pair& p, double a, double b) {
  const auto D = gradient(p);
  std::array<double, 144> K;
  for (int r = 0; r < 12; ++r)
    for (int c = 0; c < 12; ++c) K[12 * r + c] = a * D[r] * D[c];
  if (b == 0) return K;
  std::array<std::array<double, 12>, 2> N{}, S{};
  for (int c = 0; c < 3; ++c)
    for (int beta = 0; beta < 2; ++beta) {
      N[beta][3 + c] = -p.normal[c];
      N[beta][6 + 3 * beta + c] = p.normal[c];
      S[beta][c] = p.duals[beta][c];
      for (int i = 0; i < 3; ++i) S[beta][3 + 3 * i + c] = -p.weights[i] * p.duals[beta][c];
    }
  for (int beta = 0; beta < 2; ++beta)
    for (int gamma = 0; gamma < 2; ++gamma) {
      const double half = p.gap * dot(p.duals[beta], p.duals[gamma]) / 2;
      for (int i = 0; i < 12; ++i) S[beta][i] += half * N[gamma][i];
    }
  for (int beta = 0; beta < 2; ++beta)
    for (int r = 0; r < 12; ++r)
      for (int c = 0; c < 12; ++c) K[12 * r + c] -= b * (S[beta][r] * N[beta][c] + N[beta][r] * S[beta][c]);
  return K;
}

}  // namespace bulbus
