// Solid, and what its tangent does in double precision.
#include "core/element/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/base/memory.hpp"
#include "core/element/solid_kernel.hpp"
#include "core/element/solid_tangent.hpp"

namespace bulbus::inline element {
namespace {

std::array<int, 8> lexicographic(const Hex& hex) {
  std::array<int, 8> nodes;
  for (int a = 0; a < 8; ++a) nodes[a] = hex[vtk_of_lexicographic[a]];
  return nodes;
}

Pack volume_of(const ReferenceGradient<Pack>& x) {
  Pack v(0.);
  for_each_gauss_point([&](int i, int j, int k) { v += determinant(x.at(i, j, k)); });
  return v;
}

}  // namespace

Solid::Solid(std::vector<double> X, std::span<const Hex> hexes, std::vector<SolidRegion> regions)
    : X_(std::move(X)), regions_(std::move(regions)), V0_(hexes.size()) {
  for (SolidRegion& r : regions_) {
    auto packs = make_packs<8>(r.count, [&](int e) { return lexicographic(hexes[r.first + e]); });
    r.first_pack = static_cast<int>(packs_.size());
    r.packs = static_cast<int>(packs.size());
    packs_.insert(packs_.end(), packs.begin(), packs.end());
    pack_fibres(r);
  }
  for_each_pack([&](const auto&, int p, int first) {
    store_some(volume_of(reference_gradient(gather<8>(packs_[p], X_))), V0_, first, packs_[p].used);
  });
  for (int h = 0; h < this->hexes(); ++h)
    if (std::ranges::none_of(regions_,
                             [h](const SolidRegion& r) { return h >= r.first && h < r.first + r.count; }))
      rigid_.push_back(h);
  const auto packs =
      make_packs<8>(static_cast<int>(rigid_.size()), [&](int i) { return lexicographic(hexes[rigid_[i]]); });
  for (std::size_t i = 0; i < rigid_.size(); ++i)
    V0_[rigid_[i]] =
        volume_of(reference_gradient(gather<8>(packs[i / lanes], X_)))[static_cast<int>(i % lanes)];
}

void Solid::pack_fibres(SolidRegion& r) {
  r.first_fibre = static_cast<int>(fibres_.size());
  const auto* law = std::get_if<FibreReinforced>(&r.material);
  if (!law) return;
  if (r.directions.size() != 3ul * r.count * law->families)
    throw std::invalid_argument("region '" + r.name +
                                "': a direction for each family of each hexahedron is needed");
  fibres_.resize(fibres_.size() + r.packs * law->families);
  for (int p = 0; p < r.packs; ++p)
    for (int i = 0; i < law->families; ++i)
      for (int l = 0; l < lanes; ++l) {
        const int hex = std::min(p * lanes + l, r.count - 1);  // unused lanes repeat the last hexahedron
        for (int c = 0; c < 3; ++c)
          fibres_[r.first_fibre + p * law->families + i][c].v[l] =
              r.directions[3 * (hex * law->families + i) + c];
      }
  std::vector<double>().swap(r.directions);
}

void Solid::residual(std::span<const double> x, std::span<const double> lambda, std::span<double> force,
                     std::span<double> volume_defect, std::span<double> reference_force) const {
  for_each_pack([&](const auto& material, int p, int first) {
    const auto& pack = packs_[p];
    Pack volume;
    const auto f =
        internal_force(material, reference_gradient(gather(pack, x)), reference_gradient(gather<8>(pack, X_)),
                       load_some(lambda, first, pack.used), volume);
    scatter_add(pack, f, force);
    store_some(volume - load_some(V0_, first, pack.used), volume_defect, first, pack.used);
    if (reference_force.empty()) return;
    for (int l = 0; l < pack.used; ++l)
      for (int a = 0; a < 8; ++a)
        reference_force[pack.node[a][l]] += std::hypot(f[a][0][l], f[a][1][l], f[a][2][l]);
  });
}

// use(hexahedron, its least J).
template <class Use>
void Solid::for_each_least_jacobian(std::span<const double> x, Use use) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for_each_pack([&](const auto&, int p, int first) {
    const auto gx = reference_gradient(gather(packs_[p], x)),
               gX = reference_gradient(gather<8>(packs_[p], X_));
    std::array<double, lanes> least;
    least.fill(infinity);
    for_each_gauss_point([&](int i, int j, int k) {
      const Pack J = determinant(gx.at(i, j, k)) / determinant(gX.at(i, j, k));
      for (int l = 0; l < lanes; ++l) least[l] = std::isnan(J[l]) ? -infinity : std::min(least[l], J[l]);
    });
    for (int l = 0; l < packs_[p].used; ++l) use(first + l, least[l]);
  });
}

double Solid::least_jacobian(std::span<const double> x, int* hex) const {
  double least = std::numeric_limits<double>::infinity();
  for_each_least_jacobian(x, [&](int h, double J) {
    if (J >= least) return;
    least = J;
    if (hex) *hex = h;
  });
  return least;
}

std::vector<double> Solid::least_jacobians(std::span<const double> x) const {
  std::vector<double> least(V0_.size(), 1);
  for_each_least_jacobian(x, [&](int h, double J) { least[h] = J; });
  return least;
}

SolidTangent::SolidTangent(std::shared_ptr<const Solid> solid, SharedNumbers x, SharedNumbers lambda,
                           double gamma, StrainSource source)
    : solid_(std::move(solid)),
      x_(std::move(x)),
      lambda_(std::move(lambda)),
      mu_(solid_->hexes()),
      penalty_(solid_->hexes()),
      source_(source) {
  compute_moduli(gamma);
  if (source_ == StrainSource::cache) fill_cache();
}

void SolidTangent::compute_moduli(double gamma) {
  constexpr double floor = 0.1;
  for (const SolidRegion& r : solid_->regions_) {
    const double initial = initial_shear_modulus(r.material);
    if (std::holds_alternative<NeoHooke>(r.material))
      std::fill_n(mu_.begin() + r.first, r.count, initial);
    else
      std::visit(
          [&](const auto& law) {
            for (int p = 0; p < r.packs; ++p) {
              const auto& material = solid_->on_pack(law, r, p);
              const auto& pack = solid_->packs_[r.first_pack + p];
              const auto gx = reference_gradient(gather(pack, *x_)),
                         gX = reference_gradient(gather<8>(pack, solid_->X_));
              Pack mu(0.);
              for_each_gauss_point([&](int i, int j, int k) {
                const Mat3<Pack> a = gx.at(i, j, k);
                mu += 0.125 *
                      material.shear_modulus(point_strain(material, a, determinant(a), gX.at(i, j, k)).b);
              });
              for (int l = 0; l < pack.used; ++l)
                mu_[r.first + p * lanes + l] = std::max(mu[l], floor * initial);
            }
          },
          r.material);
  }
  for (int e : solid_->rigid_) mu_[e] = 1;  // any: their pressures stay as they are
  for (std::size_t e = 0; e < mu_.size(); ++e) penalty_[e] = gamma * mu_[e] / solid_->V0_[e];
}

void SolidTangent::fill_cache() {
  constexpr int per_point = cached_floats * lanes;
  cache_.resize(solid_->packs_.size() * pack_floats);
  solid_->for_each_pack([&]<class Material>(const Material& material, int p, int) {
    if constexpr (!has_fibres<Material>) {  // the strain of fibres is always recomputed
      const auto gx = reference_gradient(gather(solid_->packs_[p], *x_)),
                 gX = reference_gradient(gather<8>(solid_->packs_[p], solid_->X_));
      for_each_gauss_point([&](int i, int j, int k) {
        const Mat3<Pack> a = gx.at(i, j, k);
        const auto s = point_strain(material, a, determinant(a), gX.at(i, j, k));
        float* to = cache_.data() + (static_cast<std::size_t>(p) * 8 + i + 2 * j + 4 * k) * per_point;
        for (int c = 0; c < 6; ++c) store(s.b.v[c], to + c * lanes);
        store(s.dV0, to + 6 * lanes);
      });
    }
  });
}

void SolidTangent::apply(std::span<const double> dx, std::span<const double> dlambda, std::span<double> force,
                         std::span<double> volume_change) const {
  solid_->for_each_pack([&]<class Material>(const Material& material, int p,
                                            int first) __attribute__((flatten)) {
    const auto& pack = solid_->packs_[p];
    const Pack lambda = load_some(*lambda_, first, pack.used),
               penalty = load_some(penalty_, first, pack.used);
    const Pack dl = dlambda.empty() ? Pack(0.) : load_some(dlambda, first, pack.used);
    Pack theta;
    const auto add_action = [&](const auto& strain) {
      scatter_add(
          pack,
          tangent_action(material, strain, gather(pack, *x_), gather(pack, dx), lambda, dl, penalty, theta),
          force);
    };
    if constexpr (!has_fibres<Material>)
      if (source_ == StrainSource::cache) {
        add_action(CachedStrain{cache_.data() + static_cast<std::size_t>(p) * pack_floats});
        if (!volume_change.empty()) store_some(theta, volume_change, first, pack.used);
        return;
      }
    add_action(recomputed_strain(material, reference_gradient(gather<8>(pack, solid_->X_))));
    if (!volume_change.empty()) store_some(theta, volume_change, first, pack.used);
  });
}

void SolidTangent::apply_pressure(std::span<const double> dlambda, std::span<double> force) const {
  solid_->for_each_pack([&](const auto&, int p, int first) {
    const auto& pack = solid_->packs_[p];
    Modes<Pack> f{};
    add_pressure(volume_gradient(modes(gather(pack, *x_))), load_some(dlambda, first, pack.used), f);
    scatter_add(pack, nodal(f), force);
  });
}

void SolidTangent::volume_change(std::span<const double> dx, std::span<double> volume_change) const {
  solid_->for_each_pack([&](const auto&, int p, int first) {
    const auto& pack = solid_->packs_[p];
    const Pack theta =
        bulbus::volume_change(volume_gradient(modes(gather(pack, *x_))), modes(gather(pack, dx)));
    store_some(theta, volume_change, first, pack.used);
  });
}

std::size_t Solid::bytes() const {
  return bytes_of(X_) + bytes_of(packs_) + bytes_of(fibres_) + bytes_of(V0_);
}

std::size_t SolidTangent::bytes() const { return bytes_of(mu_) + bytes_of(penalty_) + bytes_of(single_.x); }

std::size_t SolidTangent::cache_bytes() const { return bytes_of(cache_) + bytes_of(single_.tangents); }

}  // namespace bulbus::inline element
