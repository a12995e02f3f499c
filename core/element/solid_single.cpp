#include <algorithm>

#include "core/element/single_packing.hpp"
#include "core/element/solid.hpp"
#include "core/element/solid_kernel.hpp"

namespace bulbus {
namespace {

// The cache of two packs.
struct PairedStrain {
  const float *low, *high;
  PointStrain<SinglePack> at(int i, int j, int k, const Mat3<SinglePack>&, const SinglePack&) const {
    const int offset = (i + 2 * j + 4 * k) * cached_floats * lanes;
    prefetch(low + 2 * pack_floats + offset, cached_floats * lanes);
    prefetch(high + 2 * pack_floats + offset, cached_floats * lanes);
    const auto value = [&](int c) {
      FloatVector a, b;
      std::memcpy(&a, low + offset + c * lanes, sizeof a);
      std::memcpy(&b, high + offset + c * lanes, sizeof b);
      return SinglePack(SingleVector(__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)));
    };
    PointStrain<SinglePack> s;
    for (int c = 0; c < 6; ++c) s.b.v[c] = value(c);
    s.dV0 = value(6);
    return s;
  }
};

}  // namespace

void Solid::apply_single(std::span<const float> dx, std::span<float> force) const {
  auto& s = single_;
  if (source_ != StrainSource::cache) {
    s.wide.assign(dx.begin(), dx.end());
    s.wide_force.assign(dx.size(), 0);
    apply(s.wide, {}, s.wide_force, {});
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += static_cast<float>(s.wide_force[i]);
    return;
  }
  if (s.x.empty()) s.x.assign(x_.begin(), x_.end());
  for (const SolidRegion& r : regions_) {
    const int end = r.first_pack + r.packs;
    const auto add_pairs = [&](const auto& material) __attribute__((flatten)) {
      for (int p = r.first_pack; p < end; p += 2) {
        const int other = std::min(p + 1, end - 1), first = r.first + (p - r.first_pack) * lanes;
        const PackPair pair{packs_[p], packs_[other], packs_[p].used + (other > p ? packs_[other].used : 0)};
        const PairedStrain strain{&cache_[static_cast<std::size_t>(p) * pack_floats], &cache_[static_cast<std::size_t>(other) * pack_floats]};
        SinglePack theta;
        scatter_add(pair, tangent_action(material, strain, gather(pair, s.x), gather(pair, dx), load_single(lambda_, first, pair.used),
                                         SinglePack(0.), load_single(penalty_, first, pair.used), theta),
                    force);
      }
    };
    std::visit(add_pairs, r.material);
  }
}

// Relative to one node: a translation must not drown the strain in rounding.
void Solid::apply_single(std::span<const double> dx, std::span<double> force) const {
  auto& s = single_;
  s.dx.resize(dx.size());
  for (std::size_t i = 0; i < dx.size(); i += 3)
    for (std::size_t c = 0; c < 3; ++c) s.dx[i + c] = static_cast<float>(dx[i + c] - dx[c]);
  s.force.assign(dx.size(), 0);
  apply_single(s.dx, s.force);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += s.force[i];
}

}  // namespace bulbus
