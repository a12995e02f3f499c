// Element matrices, constraint vectors and stresses: what is asked for once per linearisation or record.
#include <cmath>

#include "core/element/solid_kernel.hpp"
#include "core/element/solid_tangent.hpp"

namespace bulbus::inline element {
namespace {

using ShapeGradients = std::array<Vec3<Pack>, 8>;

// ∇ₓN_n = cof(a) ∂N_n/∂ξ / det a
ShapeGradients spatial_gradients(int i, int j, int k, const Mat3<Pack>& cof, const Pack& factor) {
  const auto reference = reference_shape_gradient(i, j, k);
  ShapeGradients g;
  for (int n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c)
      g[n][c] =
          factor * (cof(c, 0) * reference[n][0] + cof(c, 1) * reference[n][1] + cof(c, 2) * reference[n][2]);
  return g;
}

// b_e = ∂V_e/∂u, in the order of the pack's nodes.
std::array<Pack, 24> constraint(const NodalVectors<Pack>& x) {
  const NodalVectors<Pack> at = nodal(volume_gradient(modes(x)));
  std::array<Pack, 24> b;
  for (int n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c) b[3 * n + c] = at[n][c];
  return b;
}

// One Gauss point's share of the matrix: column (n, c) is the action on l = e_c ⊗ ∇ₓN_n.
template <class Material, class Strain>
void add_point(const Material& material, const Strain& s, const ShapeGradients& g, const Pack& det,
               const Pack& lambda, std::vector<Pack>& K) {
  const Pack pressure = lambda * det;
  for (int n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c) {
      Mat3<Pack> l{};
      l.m[c] = g[n];
      const Mat3<Pack> t = material.tangent(s.b, l, s.dV0, pressure);
      Pack* column = K.data() + 3 * n + c;
      for (int a = 0; a < 8; ++a)
        for (int r = 0; r < 3; ++r)
          column[24 * (3 * a + r)] += t(r, 0) * g[a][0] + t(r, 1) * g[a][1] + t(r, 2) * g[a][2];
    }
}

std::array<int, 8> nodes_of_lane(const PackNodes<8>& pack, int lane) {
  std::array<int, 8> nodes;
  for (int a = 0; a < 8; ++a) nodes[a] = pack.node[a][lane];
  return nodes;
}

// Means over the hexahedron of ∂N_a/∂ξ_d ∂N_b/∂ξ_e.
struct MeanProducts {
  double of[8][8][3][3] = {};
  MeanProducts() {
    for_each_gauss_point([&](int i, int j, int k) {
      const auto g = reference_shape_gradient(i, j, k);
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b)
          for (int d = 0; d < 3; ++d)
            for (int e = 0; e < 3; ++e) of[a][b][d][e] += .125 * g[a][d] * g[b][e];
    });
  }
};

// λ ∂²V/∂x_m∂x_n = Σ λ/det (G_m ⊗ G_n − G_n ⊗ G_m) with G = cof(a) ∂N/∂ξ: the axial vectors, for m ≤ n.
std::array<Vec3<Pack>, 64> volume_curvature(const ReferenceGradient<Pack>& x, const Pack& lambda) {
  std::array<Vec3<Pack>, 64> w{};
  for_each_gauss_point([&](int i, int j, int k) {
    const Mat3<Pack> a = x.at(i, j, k), cof = cofactor(a);
    const auto G = spatial_gradients(i, j, k, cof, Pack(1.));
    const Pack weight = lambda / determinant(a, cof);
    for (int m = 0; m < 8; ++m)
      for (int n = m + 1; n < 8; ++n) {
        const Vec3<Pack> both = cross(G[m], G[n]);
        for (int c = 0; c < 3; ++c) w[8 * m + n][c] += weight * both[c];
      }
  });
  return w;
}

// 3×3 block between two nodes.
Mat3<Pack> block_between(const MeanTangent<Pack>& C, const double (&m)[3][3]) {
  Mat3<Pack> K{};
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        K(i, j) += m[d][d] * C.along[d](i, j) + m[e][f] * C.across[d](i, j) + m[f][e] * C.across[d](j, i);
  }
  return K;
}

}  // namespace

void SolidTangent::visit_mean(const ContributionVisitor& visitor, double augmentation) const {
  static const MeanProducts products;
  std::array<Pack, 24 * 24> K;
  std::array<double, 24 * 24> lane;
  solid_->for_each_pack([&](const auto& material, int p, int first) {
    const auto& pack = solid_->packs_[p];
    const auto x = gather(pack, *x_);
    const auto gx = reference_gradient(x);
    Pack rest;
    const auto C =
        mean_tangent(material, gx, reference_gradient(gather<8>(pack, solid_->X_)),
                     load_some(*lambda_, first, pack.used), load_some(mu_, first, pack.used), rest);
    const auto w = any(rest) ? volume_curvature(gx, rest) : std::array<Vec3<Pack>, 64>{};
    const auto b = constraint(x);
    const Pack penalty = augmentation * load_some(penalty_, first, pack.used);
    for (int m = 0; m < 8; ++m)
      for (int n = m; n < 8; ++n) {
        Mat3<Pack> block = block_between(C, products.of[m][n]);
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3, k = (i + 2) % 3;
          block(i, j) += w[8 * m + n][k];
          block(j, i) -= w[8 * m + n][k];
        }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            K[24 * (3 * m + i) + 3 * n + j] = block(i, j) + penalty * b[3 * m + i] * b[3 * n + j];
      }
    for (int l = 0; l < pack.used; ++l) {
      for (int r = 0; r < 24; ++r)
        for (int c = r; c < 24; ++c) lane[24 * r + c] = lane[24 * c + r] = K[24 * r + c][l];
      visitor(nodes_of_lane(pack, l), lane);
    }
  });
}

void SolidTangent::visit(const ContributionVisitor& visitor, bool augmented) const {
  std::vector<Pack> K(24 * 24);
  std::array<double, 24 * 24> lane;
  solid_->for_each_pack([&](const auto& material, int p, int first) {
    const auto& pack = solid_->packs_[p];
    const auto gx = reference_gradient(gather(pack, *x_)),
               gX = reference_gradient(gather<8>(pack, solid_->X_));
    const Pack lambda = load_some(*lambda_, first, pack.used);
    std::fill(K.begin(), K.end(), Pack(0.));
    for_each_gauss_point([&](int i, int j, int k) {
      const Mat3<Pack> a = gx.at(i, j, k), cof = cofactor(a);
      const Pack det = determinant(a, cof);
      add_point(material, point_strain(material, a, det, gX.at(i, j, k)),
                spatial_gradients(i, j, k, cof, 1. / det), det, lambda, K);
    });
    if (augmented) {
      const auto b = constraint(gather(pack, *x_));
      const Pack penalty = load_some(penalty_, first, pack.used);
      for (int r = 0; r < 24; ++r)
        for (int c = 0; c < 24; ++c) K[24 * r + c] += penalty * b[r] * b[c];
    }
    for (int l = 0; l < pack.used; ++l) {
      for (int i = 0; i < 24 * 24; ++i) lane[i] = K[i][l];
      visitor(nodes_of_lane(pack, l), lane);
    }
  });
}

void SolidTangent::visit_constraints(
    const std::function<void(int, std::span<const int>, std::span<const double>)>& visitor) const {
  std::array<double, 24> lane;
  solid_->for_each_pack([&](const auto&, int p, int first) {
    const auto b = constraint(gather(solid_->packs_[p], *x_));
    for (int l = 0; l < solid_->packs_[p].used; ++l) {
      for (int i = 0; i < 24; ++i) lane[i] = b[i][l];
      visitor(first + l, nodes_of_lane(solid_->packs_[p], l), lane);
    }
  });
}

std::vector<CellStress> Solid::stresses(std::span<const double> x, std::span<const double> lambda) const {
  std::vector<CellStress> all(V0_.size(), CellStress{{{0, 0, 0, 0, 0, 0}}, 0});
  for_each_pack([&](const auto& material, int p, int first) {
    const auto& pack = packs_[p];
    const auto gx = reference_gradient(gather(pack, x)), gX = reference_gradient(gather<8>(pack, X_));
    for_each_gauss_point([&](int i, int j, int k) {
      const Mat3<Pack> a = gx.at(i, j, k);
      const Pack det = determinant(a);
      const auto s = point_strain(material, a, det, gX.at(i, j, k));
      const Sym3<Pack> tau = material.deviatoric(s.b);  // σ = τ / J + λ I
      const Pack per_J = s.dV0 / det, norm2 = contract(tau, tau);
      for (int l = 0; l < pack.used; ++l) {
        CellStress& cell = all[first + l];
        for (int c = 0; c < 6; ++c)
          cell.cauchy.v[c] += 0.125 * (tau.v[c][l] * per_J[l] + (c < 3 ? lambda[first + l] : 0));
        cell.mises += 0.125 * std::sqrt(1.5 * norm2[l]) * per_J[l];
      }
    });
  });
  return all;
}

double Solid::energy(std::span<const double> x) const {
  double sum = 0;
  for_each_pack([&](const auto& material, int p, int) {
    const auto& pack = packs_[p];
    const auto gx = reference_gradient(gather(pack, x)), gX = reference_gradient(gather<8>(pack, X_));
    for_each_gauss_point([&](int i, int j, int k) {
      const Mat3<Pack> a = gx.at(i, j, k);
      const auto s = point_strain(material, a, determinant(a), gX.at(i, j, k));
      const Pack w = material.energy(s.b) * s.dV0;
      for (int l = 0; l < pack.used; ++l) sum += w[l];
    });
  });
  return sum;
}

}  // namespace bulbus::inline element
