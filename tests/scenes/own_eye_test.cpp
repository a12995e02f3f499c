// The eye from a file is the eye that was generated: all that a scene names comes through.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/not_empty.hpp"
#include "tests/support/run_scene.hpp"

namespace bulbus {
namespace {

const std::string generated = R"yaml(mesh: {eye: {n: 6, detachment: {tear: {}}}}
materials: paper
bars: {zonules: {tension_only: true}}
liquids: {vitreous: {surface: cavity}}
symmetry: [x]
fix: [{set: nerve_end}]
contacts: [{name: retina, slave: retina_back, master: retina_bed}]
steps:
  - pressures: {vitreous: 15 mmHg}
  - enclose: [vitreous]
    displace: [{set: equator_band, radial: -0.3, z: 0, from: start}]
probes:
  - {name: IOP, kind: pressure, liquid: vitreous, unit: mmHg}
  - {name: volume, kind: volume, liquid: vitreous}
  - {name: length, kind: distance, set: nerve_ring, to: apex, component: z}
  - {name: pole, kind: displacement, set: retina_pole, component: z}
  - {name: band, kind: reaction, set: equator_band, component: radial}
  - {name: gap, kind: gap, contact: retina, set: detached}
  - {name: rim, kind: gap, contact: retina, set: tear_rim}
  - {name: bed, kind: displacement, set: detached_bed}
  - {name: zonules, kind: bar_force, region: zonules, statistic: max}
  - {name: lens, kind: mises, region: lens}
output: {vtk: false}
solver:
  linear: {method: direct}
  newton: {force: 1e-8}
)yaml";

TEST(OwnEye, FromAFileIsTheOneGenerated) {
  const std::string file = std::filesystem::temp_directory_path() / "bulbus_own_eye.msh";
  const auto expected = test::run_scene(generated);
  ASSERT_EQ(expected.status, 0) << expected.err;
  for (const std::string form : {"", "--text"}) {
    std::vector<std::string> arguments{"mesh", expected.folder / "scene.yaml", "-o", file};
    if (!form.empty()) arguments.push_back(form);
    std::ostringstream out, err;
    ASSERT_EQ(command_line(arguments, Comm(MPI_COMM_SELF), out, err), 0) << err.str();
    const auto probes = expected.summary()["probes"];
    const auto read =
        test::run_scene(test::replaced(generated, "eye: {n: 6, detachment: {tear: {}}}", "file: " + file));
    ASSERT_EQ(read.status, 0) << read.err;
    for (const auto& [name, value] : not_empty(probes).items()) {
      const double was = value, is = read.summary()["probes"][name];
      EXPECT_NEAR(is, was, 1e-5 * std::abs(was)) << name;
      EXPECT_GT(std::abs(was), 0) << name;
    }
    EXPECT_EQ(read.summary()["unknowns"], expected.summary()["unknowns"]);
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace bulbus
