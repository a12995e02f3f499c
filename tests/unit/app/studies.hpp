#pragma once
#include "app/study/study_design.hpp"
#include "tests/support/run_scene.hpp"

namespace bulbus::test {

/// A bar that is pulled, compressed or torn; line 12 is its first probe.
inline const std::string bar_scene = R"yaml(title: stretch
mesh: {block: {upper: [2, 1, 1], nx: 1, ny: 1, nz: 1}}
regions:
  block: {c10: 0.5}
symmetry: [y, z]
fix: [{set: xmin, directions: [x]}]
steps:
  - name: stretch
    increments: 2
    displace: [{set: xmax, x: 0.8}]
probes:
  - {name: pull, kind: reaction, set: xmax, component: x, unit: mN}
  - {name: stress, kind: mises}
solver:
  linear: {method: direct}
  newton: {max_iterations: 6}
  stepping: {minimum: 0.2}
)yaml";

/// Line 4 begins `vary`.
inline const std::string bar_study = R"yaml(title: a bar
scene: bar.yaml
set: {steps.stretch.increments: 1}
vary:
  - {name: way, keys: [steps.stretch.displace.xmax.x], values: [.2, .4, .8], unit: mm, baseline: .4}
  - {name: c10, keys: [regions.block.c10], values: [0.5 MPa, 1 MPa]}
)yaml";

/// A fresh folder that holds bar.yaml.
inline std::filesystem::path bar_folder() {
  const auto folder = fresh_folder("bulbus_study");
  std::ofstream(folder / "bar.yaml") << bar_scene;
  return folder;
}

inline Study study_from(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return study_of(parse_yaml(text, "study.yaml"), bar_folder() / "study.yaml", overrides);
}

/// A call of the command on study.yaml in the folder of the last study, which has bar.yaml.
inline Ran run_study_again(const std::string& yaml, const std::vector<std::string>& set = {},
                           const std::string& command = "study") {
  return call(command, std::filesystem::temp_directory_path() / "bulbus_study", "study.yaml", yaml, set);
}

inline Ran run_a_study(const std::string& yaml, const std::vector<std::string>& set = {},
                       const std::string& command = "study") {
  bar_folder();
  return run_study_again(yaml, set, command);
}

}  // namespace bulbus::test
