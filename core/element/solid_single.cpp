#include <algorithm>

#include "core/element/single_packing.hpp"
#include "core/element/solid.hpp"
#include "core/element/solid_kernel.hpp"

namespace bulbus {
namespace {

// The cache of two packs.
struct PairedStrain {
  const float *low, *high;
  PointStrain<SinglePack> at(int i, int j, int k, const Mat3<SinglePack>&) const {
    const int offset = (i + 2 * j + 4 * k) * cached_floats * lanes;
    const auto value = [&](int c) {
      SinglePack p;
      std::memcpy(&p.v, low + offset + c * lanes, sizeof p.v / 2);
      std::memcpy(reinterpret_cast<char*>(&p.v) + sizeof p.v / 2, high + offset + c * lanes, sizeof p.v / 2);
      return p;
    };
    PointStrain<SinglePack> s;
    for (int c = 0; c < 6; ++c) s.b.v[c] = value(c);
    s.dV0 = value(6);
    return s;
  }
};

// One number more than the nodes have: gathering reads it.
void to_single(std::span<const double> v, std::vector<float>& out) {
  out.resize(v.size() + 1);
  std::ranges::copy(v, out.begin());
}

}  // namespace

void Solid::apply_single(std::span<const double> dx, std::span<double> force) const {
  if (source_ != StrainSource::cache) return apply(dx, {}, force, {});
  auto& s = single_;
  if (s.x.empty()) to_single(x_, s.x);
  s.force.assign(dx.size(), 0);
  constexpr int per_pack = 8 * cached_floats * lanes;
  for (const SolidRegion& r : regions_) {
    const int end = r.first_pack + r.packs;
    const auto add_pairs = [&](const auto& material) __attribute__((flatten)) {
      for (int p = r.first_pack; p < end; p += 2) {
        const int other = std::min(p + 1, end - 1), first = r.first + (p - r.first_pack) * lanes;
        const PackPair pair{packs_[p], packs_[other], packs_[p].used + (other > p ? packs_[other].used : 0)};
        const PairedStrain strain{&cache_[static_cast<std::size_t>(p) * per_pack], &cache_[static_cast<std::size_t>(other) * per_pack]};
        const auto strain_of = [&](const PointValues<SinglePack>&) { return strain; };
        SinglePack theta;
        scatter_add(pair, tangent_action(material, strain_of, reference_gradient(gather(pair, s.x)), reference_gradient(gather_relative(pair, dx)),
                                         load_single(lambda_, first, pair.used), SinglePack(0.), load_single(penalty_, first, pair.used), theta),
                    s.force);
      }
    };
    std::visit(add_pairs, r.material);
  }
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += s.force[i];
}

}  // namespace bulbus
