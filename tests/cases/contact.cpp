// Contacts that were passed through, or whose sides were treated unequally.
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

// A closed form of the membrane is not known: many increments are the reference.
TEST(ThinSheet, IsCarriedAlongInAnyNumberOfIncrements) {
  for (int increments : {1, 2, 3, 5, 10}) {
    const Ran run = run_case("thin_sheet", {"steps.0.increments=" + std::to_string(increments)});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(probe(run, "lowest"), -.4, 1e-5) << increments;
    EXPECT_NEAR(probe(run, "push"), 9.488, 1e-3) << increments;
  }
}

TEST(ThinSheet, OfAnyThicknessIsCarriedAlongByARod) {
  for (const char* thickness : {".02", ".5"}) {
    std::vector<double> push;
    for (const char* increments : {"1", "10"}) {
      const Ran run = run_case("thin_sheet", {std::string("steps.0.increments=") + increments,
                                              std::string("mesh.block.upper=[1, 1, ") + thickness + "]",
                                              "rigid_bodies.rod.cylinder.center=[0, 0, 1.5]"});
      ASSERT_EQ(run.status, 0) << run.err;
      push.push_back(probe(run, "push"));
    }
    EXPECT_GT(push[1], .1) << thickness;
    EXPECT_NEAR(push[0] / push[1], 1, 1e-3) << thickness;
  }
}

TEST(Ridge, PushesNeitherWay) {
  const Ran run = run_case("ridge");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(probe(run, "push"), -100);
  EXPECT_LT(std::abs(probe(run, "side") / probe(run, "push")), 1e-6);
}

// A preset is as good as what it promises of `tight`, and one increment as good as four.
TEST(Band, ClosesOnTheEyeWithAnyPreset) {
  const std::string scene = std::string(BULBUS_DATA) + "/scenes/band.yaml";
  std::ifstream in(scene);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto closed = [&](const std::string& preset, const std::string& way, const std::string& more) {
    return run_scene(text, {"mesh.eye.n=6", "output.vtk=false", "solver.accuracy=" + preset, "steps.1.move.0.close=" + way, more});
  };
  for (const auto& [way, pressure, force] : {std::tuple{"2", 37.11, 3.351}, {"3", 53.43, 5.701}})
    for (const auto& [preset, more] : {std::pair{"fast", "steps.1.increments=4"}, {"tight", "steps.1.increments=1"}}) {
      const Ran run = closed(preset, way, more);
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_NEAR(probe(run, "IOP") / pressure, 1, 1e-3) << preset << " " << way;
      EXPECT_NEAR(probe(run, "band_force") / force, 1, 2e-3) << preset << " " << way;
    }
}

}  // namespace
}  // namespace bulbus::test
