#pragma once
#include "tests/verify/contact_trial.hpp"

namespace bulbus {

/// Half the shear modulus of the blocks, MPa.
constexpr double block_c10 = .5;

/// Two blocks 1 × 1 × 1 in all, a quarter of the whole, pressed to 0.9 of their height; the lower one may be
/// wider.
inline Scene two_blocks(int low, int high, double penalty, double tolerance = 0, double width = 1) {
  Scene scene{named_block("low", {0, 0, 0}, {width, width, .5}, low, 2), {}};
  append(scene.mesh, named_block("high", {0, 0, .5}, {1, 1, 1}, high, 2));
  Model& m = scene.model;
  m.regions = {{"low", neo_hooke(block_c10)}, {"high", neo_hooke(block_c10)}};
  m.symmetry = {"x", "y"};
  m.fix.push_back({"low zmin", {"z"}});
  m.contacts = {contact_between("joint", "high zmin", "low zmax")};
  m.contacts[0].penalty = penalty, m.contacts[0].tolerance = tolerance;
  StepSpec press = step("press", 2);
  DisplaceSpec d = displace("high zmax");
  d.z = "-0.1";
  press.displace = {d};
  m.steps = {press};
  return scene;
}

/// Nominal stress of uniaxial stretch, MPa.
inline double uniaxial(double l) { return 2 * block_c10 * (l - 1 / (l * l)); }

/// The same where the springs of the penalty take their part of the squeeze: α g = −P(0.9 + g).
inline double with_penalty(double alpha) {
  double g = 0;
  for (int i = 0; i < 50; ++i)
    g -= (alpha * g + uniaxial(.9 + g)) / (alpha + 2 * block_c10 * (1 + 2 / std::pow(.9 + g, 3)));
  return uniaxial(.9 + g);
}

}  // namespace bulbus
