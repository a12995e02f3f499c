#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/scene/scene.hpp"
#include "core/base/error.hpp"

namespace bulbus::test {

/// A scene that says a little of everything. Line numbers in tests count from its first line.
inline const std::string full_scene = R"yaml(title: "a: test"
mesh: {block: {upper: [2 cm, 1, 1], nx: 3}}
regions:
  block: {c10: 15 mmHg, terms: [{r: 2, s: 1, c: 1 kPa}]}
  plate: {rigid: yes}
bars:
  fibres: {area: 1e-3, tension_only: true}
liquids:
  inside: {surface: cavity}
symmetry: [x]
fix:
  - {set: bottom}
  - {set: top, directions: [y]}
steps:
  - name: inflate
    pressures: {inside: 15 mmHg}
  - name: indent
    increments: 4
    enclose: [inside]
    add: {inside: -2 uL}
    displace:
      - {set: plate, x: 1 um, y: "0.1*s*(X - 2)", rotate: {angle: 90 deg}, translate: [1, 2, 0.5 cm]}
      - {set: side, radial: -0.5, affine: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
    loads:
      - {surface: top, pressure: "t*2e-3", dead: on}
      - {set: tip, force: [0, 0, 100 mN]}
  - release: [side]
probes:
  - {name: p, kind: pressure, liquid: inside, unit: mmHg}
solver:
  linear: {operator: assembled, gamma: 20}
output: {every: 2}
)yaml";

/// The least that is a scene; `more` follows it.
inline std::string least_scene(const std::string& more = "") {
  return "mesh: {block: {}}\nregions: {}\nsteps: []\n" + more;
}

/// Reading fails with a message that begins with `start` and contains `part`.
inline void expect_error(const std::string& text, const std::string& start, const std::string& part,
                         const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "scene.yaml", overrides);
    ADD_FAILURE() << "no error; expected: " << start;
  } catch (const InputError& fault) {
    const std::string message = fault.what();
    EXPECT_EQ(message.substr(0, start.size()), start) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

}  // namespace bulbus::test
