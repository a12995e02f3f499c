#include "core/mesh/prolongation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/memory.hpp"
#include "core/base/tensor.hpp"
#include "core/mesh/corners.hpp"

namespace bulbus::inline mesh {
namespace {

struct Weights {
  double value[8];
};

// Trilinear weights at ξ in the unit cube and, linearised, at the position x beside it.
Weights weights_at(const Hex& hex, std::span<const double> places, const double* xi, const double* x) {
  double N[8], dN[8][3], rest[3];
  Mat3<double> a{};
  for (int c = 0; c < 3; ++c) rest[c] = x[c];
  for (int k = 0; k < 8; ++k) {
    double f[3];
    for (int i = 0; i < 3; ++i) f[i] = unit_cube[k][i] == 1 ? xi[i] : 1 - xi[i];
    N[k] = f[0] * f[1] * f[2];
    for (int i = 0; i < 3; ++i) dN[k][i] = (unit_cube[k][i] == 1 ? 1 : -1) * f[(i + 1) % 3] * f[(i + 2) % 3];
    for (int c = 0; c < 3; ++c) {
      const double p = places[3 * hex[k] + c];
      rest[c] -= N[k] * p;
      for (int i = 0; i < 3; ++i) a(c, i) += p * dN[k][i];
    }
  }
  const Mat3<double> cof = cofactor(a);  // a⁻¹ = cofᵀ / det
  const double det = determinant(a);
  Weights w;
  for (int k = 0; k < 8; ++k) {
    w.value[k] = N[k];
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) w.value[k] += dN[k][i] * cof(c, i) * rest[c] / det;
  }
  return w;
}

}  // namespace

Interpolation::Stencil Interpolation::stencil(int node) const {
  const std::size_t first = start_[node], count = start_[node + 1] - start_[node];
  return {std::span(nodes_).subspan(first, count), std::span(weights_).subspan(first, count)};
}

void Interpolation::add(int node, double weight) {
  if (std::abs(weight) < 1e-6) return;
  nodes_.push_back(node);
  weights_.push_back(static_cast<float>(weight));
}

void Interpolation::apply(std::span<const double> coarse, std::span<double> fine) const {
  for (int n = 0; n < owned_; ++n) {
    double sum[3] = {};
    for (int k = start_[n]; k < start_[n + 1]; ++k)
      for (int c = 0; c < 3; ++c) sum[c] += weights_[k] * coarse[3 * nodes_[k] + c];
    for (int c = 0; c < 3; ++c) fine[3 * n + c] = sum[c];
  }
}

void Interpolation::apply_transposed(std::span<const double> fine, std::span<double> coarse) const {
  std::fill(coarse.begin(), coarse.end(), 0.0);
  for (int n = 0; n < owned_; ++n)
    for (int k = start_[n]; k < start_[n + 1]; ++k)
      for (int c = 0; c < 3; ++c) coarse[3 * nodes_[k] + c] += weights_[k] * fine[3 * n + c];
  coarse_halo_.accumulate_ghosts(coarse);
}

std::size_t Interpolation::bytes() const { return bytes_of(start_) + bytes_of(nodes_) + bytes_of(weights_); }

Prolongation::Prolongation(const ParentsOf& parents_of, const LocalMesh& coarse, const LocalMesh& fine)
    : coarse_(coarse), fine_(fine), same_(coarse.owned), lone_start_{0} {
  for (std::size_t h = 0; h < coarse.hexes.size(); ++h)
    for (int c = 0; c < 8; ++c)
      if (const int n = coarse.hexes[h][c]; n < coarse.owned) same_[n] = fine.hexes[8 * h + c][c];
  std::vector<bool> met(fine.nodes());
  for (const Hex& h : fine.hexes)
    for (int n : h) met[n] = true;
  first_lone_ = fine.owned;
  while (first_lone_ < fine.nodes() && met[first_lone_]) ++first_lone_;
  for (int n = first_lone_; n < fine.nodes(); ++n) {
    const auto parents = parents_of(fine.input_node[n]), known = coarse.local(parents);
    if (known.size() == parents.size()) lone_parents_.insert(lone_parents_.end(), known.begin(), known.end());
    lone_start_.push_back(static_cast<int>(lone_parents_.size()));
  }
}

Interpolation Prolongation::at(std::span<const double> coarse_x, std::span<const double> fine_x,
                               std::span<const double> stiffness) const {
  struct Site {
    int hex = -1, child = 0, corner = 0;
  };
  std::vector<Site> site(fine_.nodes());
  for (int h = 0; h < static_cast<int>(fine_.hexes.size()); ++h)
    for (int k = 0; k < 8; ++k) {
      Site& s = site[fine_.hexes[h][k]];
      if (s.hex < 0 || stiffness[h / 8] > stiffness[s.hex]) s = {h / 8, h % 8, k};
    }
  Interpolation I(fine_.owned, coarse_.halo);
  for (int n = 0; n < fine_.nodes(); ++n) {
    if (const Site& s = site[n]; s.hex >= 0) {
      const Hex& hex = coarse_.hexes[s.hex];
      double xi[3];
      for (int i = 0; i < 3; ++i) xi[i] = .5 * (unit_cube[s.child][i] + unit_cube[s.corner][i]);
      const Weights w = weights_at(hex, coarse_x, xi, &fine_x[3 * n]);
      for (int k = 0; k < 8; ++k) I.add(hex[k], w.value[k]);
    } else if (n >= first_lone_) {
      const int first = lone_start_[n - first_lone_], last = lone_start_[n - first_lone_ + 1];
      for (int k = first; k < last; ++k) I.add(lone_parents_[k], 1.0 / (last - first));
    }
    I.start_.push_back(static_cast<int>(I.nodes_.size()));
  }
  return I;
}

void Prolongation::inject(std::span<const double> fine, std::span<double> coarse) const {
  for (int n = 0; n < coarse_.owned; ++n)
    for (int c = 0; c < 3; ++c) coarse[3 * n + c] = fine[3 * same_[n] + c];
  coarse_.halo.update_ghosts(coarse);
}

std::size_t Prolongation::bytes() const {
  return bytes_of(same_) + bytes_of(lone_start_) + bytes_of(lone_parents_);
}

}  // namespace bulbus::inline mesh
