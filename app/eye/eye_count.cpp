#include "app/eye/eye_count.hpp"

#include "app/eye/eye_map.hpp"

namespace bulbus::inline eye {

MeshCount count(const EyeSettings& s) {
  s.shape.check();
  const EyeMap map(s);
  const EyeSheet sheet = eye_sheet(s);
  const auto levels = [&](double t) { return t < s.shape.ciliary_end ? map.inner : map.wall; };
  MeshCount all = layered(count(map.lens_disc, true), map.lens_layers);
  all.hexes += double(sheet.nerve_quads) * map.nerve;
  all.nodes += double(sheet.nerve_nodes) * map.nerve;
  for (int q = 0; q < static_cast<int>(sheet.quads.size()); ++q) all.hexes += levels(sheet.middle(q));
  for (const auto& n : sheet.nodes) all.nodes += levels(n.t) + 1;
  return all;
}

}  // namespace bulbus::inline eye
