#pragma once
#include "app/eye/eye.hpp"
#include "app/eye/tissues.hpp"
#include "tests/support/models.hpp"

namespace bulbus {

/// The half eye: filled to 15 mmHg, then its equator pressed inwards by a buckle of 2 mm while the liquid is
/// enclosed.
inline Scene small_eye(int n) {
  EyeSettings settings;
  settings.n = n;
  Scene scene{generate(settings), {}};
  Model& m = scene.model;
  add_tissues("paper", scene.mesh.region_names, m);
  m.bars["zonules"] = {};
  m.liquids["vitreous"] = {.surface = "cavity"};
  m.symmetry = {"x"};
  m.fix.push_back({"nerve_end", {"x", "y", "z"}});
  StepSpec fill = step("fill"), buckle = step("buckle", 4);
  fill.pressures["vitreous"] = "1.99984e-3";
  buckle.enclose = {"vitreous"};
  DisplaceSpec d = displace("equator_band");
  d.radial = "-2";
  d.from = "start";
  buckle.displace.push_back(d);
  m.steps = {fill, buckle};
  return scene;
}

/// The band does not slide: stable all the way.
inline Scene held_band(Scene eye) {
  eye.model.steps[1].displace[0].z = "0";
  return eye;
}

}  // namespace bulbus
