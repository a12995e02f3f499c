#include "core/element/single_packing.hpp"
#include "core/element/solid_kernel.hpp"
#include "core/element/solid_tangent.hpp"

namespace bulbus::inline element {
namespace {

// use(coefficient, in single precision) for all of a mean tangent
template <class Use>
void for_each_coefficient(const MeanTangent<Pack>& C, MeanTangent<SinglePack>& single, Use use) {
  for (int d = 0; d < 3; ++d) {
    for (int k = 0; k < 6; ++k) use(C.along[d].v[k], single.along[d].v[k]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) use(C.across[d](i, j), single.across[d](i, j));
  }
}

__attribute__((flatten)) void add_action(const PackPair& pair, const SingleTangent& tangent,
                                         std::span<const NodeSingle> x, std::span<const NodeSingle> dx,
                                         std::span<NodeSingle> force) {
  const Modes<SinglePack> change = modes(gather(pair, dx)), place = modes(gather(pair, x)),
                          b = volume_gradient(place);
  Modes<SinglePack> f = action(tangent.C, change);
  if (tangent.curved) add_pressure(volume_gradient_change(place, change), tangent.lambda, f);
  add_pressure(b, tangent.penalty * volume_change(b, change), f);
  scatter_add(pair, nodal(f), force);
}

}  // namespace

void SolidTangent::round_places() const {
  if (!single_.x.empty()) return;
  const std::vector<double>& x = *x_;
  single_.x.resize(x.size() / 3);
  for (std::size_t n = 0; n < single_.x.size(); ++n) single_.x[n] = rounded(&x[3 * n]);
}

void SolidTangent::fill_tangents() const {
  std::size_t pairs = 0;
  for (const SolidRegion& r : solid_->regions_) pairs += (r.packs + 1) / 2;
  single_.tangents.clear();
  single_.tangents.reserve(pairs);
  for (const SolidRegion& r : solid_->regions_) {
    const auto store_all = [&](const auto& law) {
      for (int p = 0; p < r.packs; ++p) {
        const PackNodes<8>& pack = solid_->packs_[r.first_pack + p];
        const int first = r.first + p * lanes, half = p % 2 * lanes;
        Pack rest;
        const auto C =
            mean_tangent(solid_->on_pack(law, r, p), reference_gradient(gather(pack, *x_)),
                         reference_gradient(gather<8>(pack, solid_->X_)),
                         load_some(*lambda_, first, pack.used), load_some(mu_, first, pack.used), rest);
        if (half == 0) single_.tangents.push_back({});
        SingleTangent& to = single_.tangents.back();
        const auto put = [&](const Pack& from, SinglePack& single) {
          store(from, reinterpret_cast<float*>(&single.v) + half);
        };
        for_each_coefficient(C, to.C, put);
        put(rest, to.lambda);
        to.curved |= any(rest);
        put(load_some(penalty_, first, pack.used), to.penalty);
      }
    };
    std::visit(store_all, r.material);
  }
}

// body(pair, its first hexahedron)
template <class Body>
void SolidTangent::for_each_pair(Body body) const {
  for (const SolidRegion& r : solid_->regions_)
    for (int p = 0; p < r.packs; p += 2) {
      const PackNodes<8>&low = solid_->packs_[r.first_pack + p],
            &high = solid_->packs_[r.first_pack + std::min(p + 1, r.packs - 1)];
      body(PackPair{low, high, p + 1 < r.packs ? lanes + high.used : low.used}, r.first + p * lanes);
    }
}

void SolidTangent::apply_single(std::span<const NodeSingle> dx, std::span<NodeSingle> force) const {
  round_places();
  if (single_.tangents.empty()) fill_tangents();
  auto tangent = single_.tangents.begin();
  for_each_pair([&](const PackPair& pair, int) { add_action(pair, *tangent++, single_.x, dx, force); });
}

void SolidTangent::apply_pressure_single(std::span<const double> dlambda, std::span<NodeSingle> force) const {
  round_places();
  for_each_pair([&](const PackPair& pair, int first) __attribute__((flatten)) {
    SinglePack p(0.);
    for (int l = 0; l < pair.used; ++l) p.v[l] = static_cast<float>(dlambda[first + l]);
    Modes<SinglePack> f{};
    add_pressure(volume_gradient(modes(gather(pair, single_.x))), p, f);
    scatter_add(pair, nodal(f), force);
  });
}

void SolidTangent::volume_change_single(std::span<const NodeSingle> dx,
                                        std::span<double> volume_change) const {
  round_places();
  for_each_pair([&](const PackPair& pair, int first) __attribute__((flatten)) {
    const SinglePack theta =
        bulbus::volume_change(volume_gradient(modes(gather(pair, single_.x))), modes(gather(pair, dx)));
    for (int l = 0; l < pair.used; ++l) volume_change[first + l] = theta[l];
  });
}

}  // namespace bulbus::inline element
