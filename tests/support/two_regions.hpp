#pragma once
#include <algorithm>

#include "core/mesh/faces.hpp"
#include "tests/support/models.hpp"

namespace bulbus {

/// Four hexahedra in a row along x, fixed at the left; regions by hexahedron.
inline Scene row_of_four(const std::vector<int>& region, std::vector<std::string> names) {
  Scene s{generate(BlockShape{.upper = {4, 1, 1}, .nx = 4}), {}};
  s.mesh.region = region;
  s.mesh.region_names = std::move(names);
  for (const std::string& name : s.mesh.region_names) s.model.regions[name] = neo_hooke(.5);
  s.model.fix.push_back({"xmin", {"x", "y", "z"}});
  s.model.steps = {step("one"), step("two")};
  return s;
}

/// Two of them `left`, two `right`, and the surface `mid` between, out of the right ones.
inline Scene two_regions() {
  Scene s = row_of_four({1, 1, 0, 0}, {"right", "left"});
  for (int f = 12; f < 18; ++f)  // of the third hexahedron
    if (const Quad q = face_nodes(s.mesh.hexes, f);
        std::ranges::all_of(q, [&](int n) { return s.mesh.points[n][0] == 2; }))
      s.mesh.surfaces["mid"] = {q};
  return s;
}

/// A pressure on `mid` that acts on one of both.
inline LoadSpec on_side(const std::string& region, const std::string& pressure) {
  LoadSpec load;
  load.surface = "mid", load.pressure = pressure, load.region = region;
  return load;
}

}  // namespace bulbus
