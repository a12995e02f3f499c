// Contacts that were passed through, or whose sides were treated unequally.
#include <fmt/format.h>

#include "tests/cases/run_case.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus::test {
namespace {

// A closed form of the membrane is not known: many increments and facets are the reference. The rod's 96
// facets are to act as the circle that they stand for.
TEST(ThinSheet, IsCarriedAlongInAnyNumberOfIncrements) {
  for (int increments : {1, 2, 3, 5, 10}) {
    const Ran run = run_case("thin_sheet", {"steps.0.increments=" + std::to_string(increments)});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(probe(run, "lowest"), -.4, 1e-5) << increments;
    EXPECT_NEAR(probe(run, "push"), 9.49266, 1e-4) << increments;
  }
  for (const char* facets : {"24", "960"})
    EXPECT_NEAR(
        probe(run_case("thin_sheet", {std::string("rigid_bodies.rod.cylinder.facets=") + facets}), "push"),
        9.49266, 1e-4)
        << facets;
}

TEST(ThinSheet, OfAnyThicknessIsCarriedAlongByARodOrABall) {
  for (const char* body : {"cylinder: {center: [0,0,1.5], axis: [0,1,0], radius: 0.5, length: 6}",
                           "sphere: {center: [0,0,1.5], radius: 0.5}"})
    for (const char* thickness : {".02", ".5"}) {
      std::vector<double> push;
      for (const char* increments : {"1", "2", "10"}) {
        const Ran run = run_case("thin_sheet", {std::string("steps.0.increments=") + increments,
                                                std::string("mesh.block.upper=[1, 1, ") + thickness + "]",
                                                std::string("rigid_bodies.rod={") + body + "}"});
        ASSERT_EQ(run.status, 0) << run.err;
        push.push_back(probe(run, "push"));
      }
      EXPECT_GT(push[2], .1) << body << thickness;
      for (double p : not_empty(push)) EXPECT_NEAR(p / push[2], 1, 1e-3) << body << thickness;
    }
}

// Where a body is brought to touch is measured to its curved surface, as gaps are.
TEST(ThinSheet, IsMetByRoundBodiesBetweenTheirFacetsCorners) {
  for (const char* body : {"cylinder: {center: [0.07,0,1.5], axis: [0,1,0], radius: 0.5, length: 6}",
                           "sphere: {center: [0.07,0.03,1.5], radius: 0.5}"})
    for (const char* divisions : {"0", "3"}) {
      const Ran run = run_case(
          "thin_sheet", {"mesh.block.upper=[1, 1, .02]", std::string("contacts.0.divisions=") + divisions,
                         std::string("rigid_bodies.rod={") + body + "}"});
      ASSERT_EQ(run.status, 0) << run.err << body << divisions;
      EXPECT_GT(probe(run, "push"), .1) << body << divisions;
    }
}

// Edges of a slave may have four faces, as in meshes of voxels: the warning at the end splits it into
// triangles.
TEST(Voxels, OfASlaveMayMeetAtEdges) {
  const Ran run = run_case("voxels");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(probe(run, "push"), 0);
}

// Only the punch's nodes touch.
TEST(Punch, HasAnAreaInContactBothWays) {
  const Ran run = run_case("punch", {"contacts.0.two_way=true",
                                     "probes=[{name: area, kind: contact_area, contact: joint}, {name: mean, "
                                     "kind: mean_contact_pressure, contact: joint}]"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(probe(run, "area"), 0);
  EXPECT_GT(probe(run, "mean"), 0);
}

// The slab's faces are sixteen times as large as the punch's.
TEST(Punch, HasTheAreaOfTheFinerSide) {
  const Ran run =
      run_case("punch", {"contacts.0={name: joint, slave: punch_bottom, master: slab_top, "
                         "two_way: true, divisions: 2}",
                         "probes=[{name: part, kind: contact_fraction, contact: joint}, {name: area, "
                         "kind: contact_area, contact: joint}]"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(probe(run, "part"), .5);
  EXPECT_LE(probe(run, "part"), 1);
  EXPECT_LT(probe(run, "area"), .4);
}

// Narrower than an edge of the slave, then wider.
TEST(LineContact, HasNoMeanPressureAboveTheLargest) {
  for (int refine : {0, 2}) {
    const Ran run = run_scene(R"(
mesh: {block: {upper: [8, 4, 2], nx: 4, ny: 2, nz: 2}}
regions: {block: {c10: 50 kPa}}
fix: [{set: zmin}]
rigid_bodies: {rod: {cylinder: {center: [4, 2, 4.05], axis: [0, 1, 0], radius: 2, length: 8}}}
contacts: [{name: c, slave: zmax, master: rod}]
steps: [{name: press, increments: 3, move: [{body: rod, translate: [0, 0, -0.1]}]}]
probes:
  - {name: area, kind: contact_area, contact: c}
  - {name: mean, kind: mean_contact_pressure, contact: c}
  - {name: most, kind: contact_pressure, contact: c}
)",
                              {"mesh.refine=" + std::to_string(refine)});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_GT(probe(run, "area"), 1);
    EXPECT_LE(probe(run, "mean"), probe(run, "most") * (1 + 1e-9));
  }
}

// Farther away than the model is large.
TEST(FarBody, IsNotTakenForAClosedGap) {
  const Ran run = run_scene(R"(
mesh: {block: {upper: [.1, .1, .1], nx: 2, ny: 2, nz: 2}}
regions: {block: {c10: 50 kPa}}
fix: [{set: zmin}]
rigid_bodies: {plate: {plane: {point: [.05, .05, .9], normal: [0, 0, -1]}}}
contacts: [{name: c, slave: zmax, master: plate}]
steps: [{name: away, move: [{body: plate, translate: [0, 0, -.1]}]}]
probes:
  - {name: closed, kind: closed_fraction, contact: c}
  - {name: gap, kind: gap, contact: c}
)");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(probe(run, "closed"), 0);
  EXPECT_NEAR(probe(run, "gap"), .7, 1e-12);
}

TEST(Ridge, PushesNeitherWay) {
  const Ran run = run_case("ridge");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(probe(run, "push"), -100);
  EXPECT_LT(std::abs(probe(run, "side") / probe(run, "push")), 1e-6);
}

TEST(Ridge, PushesPointsOfFacesNeitherWay) {
  const Ran run = run_case("ridge", {"contacts.0.divisions=2"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(std::abs(probe(run, "side") / probe(run, "push")), 1e-6);
}

// The nodes of the block's lower edge lie in the concave edge of floor and wall, which keep them out
// together.
TEST(Corner, KeepsNodesOutOfFloorAndWall) {
  std::vector<double> push, side;
  for (const char* how : {"solver.linear.method=direct", "solver.linear.method=iterative",
                          "steps.0.increments=1", "contacts.0.tolerance=1e-5"}) {
    const Ran run = run_case("corner", {how});
    ASSERT_EQ(run.status, 0) << run.err;
    push.push_back(probe(run, "push")), side.push_back(probe(run, "side"));
    EXPECT_LT(push.back(), -100);
    EXPECT_GT(side.back(), 50);
    EXPECT_LT(probe(run, "penetration"), .05) << how;
  }
  for (int k : {1, 2}) {
    EXPECT_NEAR(push[k] / push[0], 1, 1e-6);
    EXPECT_NEAR(side[k] / side[0], 1, 1e-6);
  }
}

// 0.1 (1/0.64 − 0.8) 4 mm² of a block of 50 kPa; with a penalty both blocks are a little higher.
TEST(MatchingNodes, ArePressedIterativelyAsDirectly) {
  const Ran augmented = run_case("matching_nodes", {"solver.linear.fallback=none"});
  ASSERT_EQ(augmented.status, 0) << augmented.err;
  EXPECT_NEAR(probe(augmented, "push"), -305, 1e-3);
  for (const char* penalty : {"30", "300", "3e5"}) {
    const std::vector<std::string> set{"contacts.0.tolerance=0", std::string("contacts.0.penalty=") + penalty,
                                       "solver.linear.fallback=none"};
    auto direct = set;
    direct.push_back("solver.linear.method=direct");
    const Ran iterative = run_case("matching_nodes", set);
    ASSERT_EQ(iterative.status, 0) << iterative.err;
    const auto totals = iterative.summary()["totals"];
    EXPECT_EQ(totals["cuts"], 0) << penalty;
    EXPECT_LE(totals["newton_iterations"], 32) << penalty;  // 8 in each of four increments
    EXPECT_NEAR(probe(iterative, "push") / probe(run_case("matching_nodes", direct), "push"), 1, 1e-6)
        << penalty;
  }
}

TEST(RodOverEdge, TakesAsManyIncrementsIterativelyAsDirectly) {
  std::ifstream in(std::string(BULBUS_DATA) + "/scenes/rod_over_edge.yaml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<int> increments;
  for (const char* method : {"direct", "iterative"}) {
    const Ran run =
        run_scene(text, {std::string("solver.linear.method=") + method, "solver.linear.fallback=none"});
    ASSERT_EQ(run.status, 0) << run.err;
    increments.push_back(run.summary()["totals"]["increments"]);
  }
  EXPECT_LE(increments[1], 1.2 * increments[0]);
}

// A preset is as good as what it promises of `tight` in eight increments, whose figures these are, and one
// increment as good as four.
TEST(Band, ClosesOnTheEyeWithAnyPreset) {
  const std::string scene = std::string(BULBUS_DATA) + "/scenes/band.yaml";
  std::ifstream in(scene);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto closed = [&](const std::string& preset, const std::string& way, const std::string& more) {
    return run_scene(text, {"mesh.eye.n=6", "output.vtk=false", "solver.accuracy=" + preset,
                            "steps.1.move.0.close=" + way, more});
  };
  for (const auto& [way, pressure, force] : {std::tuple{"2", 37.063, 3.3440}, {"3", 53.382, 5.6937}})
    for (const auto& [preset, more] :
         {std::pair{"fast", "steps.1.increments=4"}, {"tight", "steps.1.increments=1"}}) {
      const Ran run = closed(preset, way, more);
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_NEAR(probe(run, "IOP") / pressure, 1, 1e-3) << preset << " " << way;
      EXPECT_NEAR(probe(run, "band_force") / force, 1, 2e-3) << preset << " " << way;
    }
}

std::string reason(const Ran& run) { return run.summary()["reason"]; }

// A punch that presses between the nodes of the slab: 0.2 mm deep without a force is not an answer.
TEST(Punch, BetweenTheNodesOfTheSlaveIsRefusedUnlessItIsFelt) {
  const Ran one_way = run_case("punch");
  EXPECT_EQ(one_way.status, 1);
  for (const char* part : {"enters between the nodes", "two_way: true"})
    for (const char* key : {"reason", "diagnosis"}) {
      const std::string told = one_way.summary()[key];
      EXPECT_NE(told.find(part), std::string::npos) << key << ": " << told;
    }
  std::vector<double> push;
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"contacts.0.two_way=true"},
        {"contacts.0.two_way=true", "solver.linear.method=direct"},
        {"contacts.0.slave=punch_bottom", "contacts.0.master=slab_top"}}) {
    const Ran run = run_case("punch", set);
    ASSERT_EQ(run.status, 0) << run.err;
    push.push_back(probe(run, "push"));
    EXPECT_LT(push.back(), -50);
    EXPECT_NEAR(probe(run, "hold") / -push.back(), 1, 1e-5);
    EXPECT_NEAR(std::abs(probe(run, "touch")) / -push.back(), 1, 1e-5) << "the figures count both ways";
    EXPECT_EQ(run.summary()["totals"]["cuts"], 0);
  }
  for (double p : not_empty(push)) EXPECT_NEAR(p / push[0], 1, 1e-6) << "only the punch's nodes touch";
}

TEST(Punch, TwoWayIsForSurfacesOfTheMesh) {
  expect_refused(run_case("narrow_rod", {"contacts.0.two_way=true"}), {"contacts.0.two_way", "divisions"});
  expect_refused(run_case("punch", {"contacts.0.two_way=true", "contacts.0.tolerance=1e-4"}),
                 {"contacts.0.two_way", "penalty"});
}

// A rod of 0.4 mm between nodes 1 mm apart: a face cannot bend around it.
TEST(NarrowRod, IsRefusedWhereTheFacesCannotFollowIt) {
  const Ran nodes = run_case("narrow_rod");
  EXPECT_EQ(nodes.status, 1);
  for (const char* part : {"enters between the nodes", "divisions"})
    EXPECT_NE(reason(nodes).find(part), std::string::npos) << reason(nodes);
  EXPECT_EQ(run_case("narrow_rod", {"contacts.0.divisions=4"}).status, 1)
      << "points would slip around the rod";
}

// How many warnings of a run say so.
int said(const Ran& run, const std::string& words) {
  const auto warnings = run.summary()["warnings"];
  return static_cast<int>(std::ranges::count_if(warnings, [&](const auto& w) {
    return w.template get<std::string>().find(words) != std::string::npos;
  }));
}

TEST(NarrowRod, ThatIsLetInDeepIsToldOf) {
  for (const bool deep : {false, true}) {
    const Ran run =
        run_case("narrow_rod", {"contacts.0.divisions=8", std::string("steps.0.move.0.translate=[0, 0, ") +
                                                              (deep ? "-0.3" : "-0.13") + "]"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_GT(probe(run, "push"), 10);
    EXPECT_EQ(said(run, "of the thinner layer"), deep);
    EXPECT_EQ(said(run, "larger than 3 MPa/mm"), deep ? 2 : 1) << "of the depth, and of the energy";
    EXPECT_EQ(run.summary()["warnings"].size(), deep ? 2 : 1);
  }
}

// A plane without a size ends nowhere on the model, and comes to touch alike whatever the model's size.
TEST(Plate, SqueezesBlocksOfAnySizeAlike) {
  const double l = .9, exact = 2 * .05 * (1 / (l * l) - l) * 4e4;  // of the whole, in N at 100 mm
  for (const char* size : {"1e-5", "1", "20"}) {
    const double s = std::stod(size);
    const auto times = [&](double x) { return fmt::format("{}", x * s); };
    const Ran run = run_case("plate", {fmt::format("mesh.block.upper=[{0}, {0}, {1}]", times(100), times(50)),
                                       fmt::format("rigid_bodies.plate.plane.point=[0, 0, {}]", times(50.5)),
                                       "contacts.0.tolerance=" + times(1e-4),
                                       fmt::format("steps.0.move.0.translate=[0, 0, {}]", times(-5))});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(probe(run, "force") / (s * s * exact), 1, 2e-4) << size;
  }
}

// Surfaces that no contact names go through one another unhindered.
TEST(Crossing, OfSurfacesWithoutAContactIsToldOf) {
  const Ran blocks = run_case("matching_nodes", {"contacts=[]", "probes=[]"});
  EXPECT_EQ(blocks.status, 0) << blocks.err;
  EXPECT_EQ(said(blocks, "' passes through region '"), 1);
  EXPECT_EQ(said(run_case("matching_nodes"), "passes through"), 0);
  const Ran rod = run_case("narrow_rod", {"contacts.0.slave=xmin"});
  EXPECT_EQ(rod.status, 0) << rod.err;
  EXPECT_EQ(said(rod, "rigid body 'rod' passes through region 'block'"), 1);
}

// With the coarser side as the slave a ninth of the force is lost.
TEST(CoarseSlave, IsToldOf) {
  const double exact = 400 * (1 / (.85 * .85) - .85);
  const auto force_and_warnings = [&](const std::vector<std::string>& set) {
    const Ran run = run_case("coarse_slave", set);
    EXPECT_EQ(run.status, 0) << run.err;
    return std::pair(std::abs(probe(run, "push")) / exact, said(run, "2.2 times as large"));
  };
  const auto [coarse, told] = force_and_warnings({});
  EXPECT_LT(coarse, .95);
  EXPECT_EQ(told, 1);
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"contacts.0.slave=lowtop", "contacts.0.master=highbot"},
        {"contacts.0.two_way=true", "contacts.0.tolerance=0", "contacts.0.penalty=100"}}) {
    const auto [fine, untold] = force_and_warnings(set);
    EXPECT_NEAR(fine, 1, .02);
    EXPECT_EQ(untold, 0);
  }
}

// It is 0.38 mm deep in the slab, and no point of the slave feels it.
TEST(Tip, BetweenThePointsIsToldOf) {
  for (const char* divisions : {"0", "2"}) {
    const Ran run = run_case("tip", {std::string("contacts.0.divisions=") + divisions});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LT(probe(run, "push"), 1) << divisions;
    EXPECT_EQ(said(run, "'tip' enters 'zmax' by 0.38 mm"), 1) << divisions;
  }
  EXPECT_EQ(said(run_case("ridge"), "between the points"), 0);
}

// Of two blocks in series the force is too small by the part of the energy that the penalty holds.
TEST(Penalty, ThatHoldsMuchOfTheEnergyIsToldOf) {
  const auto force_and_warnings = [](const char* penalty) {
    const Ran run =
        run_case("matching_nodes", {"contacts.0.tolerance=0", std::string("contacts.0.penalty=") + penalty});
    return std::pair(std::abs(probe(run, "push")), said(run, "of the energy"));
  };
  const auto [soft, told] = force_and_warnings("1");
  const auto [hard, untold] = force_and_warnings("100");
  EXPECT_LT(soft, .9 * hard);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(untold, 0);
}

TEST(LostString, IsToldWithSutureAndPoint) {
  const Ran run = run_case("lost_string");
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string told = run.summary()["warnings"].dump();
  EXPECT_NE(told.find("point 0 of suture 'string', ("), std::string::npos) << told;
  EXPECT_NE(told.find("no tangent to the outline of 'tire'"), std::string::npos) << told;
  const Ran before = run_case("lost_string", {"steps=[{name: sew, sew: {string: 0.02}}]"});
  EXPECT_EQ(before.text("summary.json").find("no tangent"), std::string::npos);
}

// A plane goes up to 200 mm through a block of 1 mm, a hundred times farther than the search follows.
TEST(FarPlane, DoesNotPassThrough) {
  for (const char* way : {"-200", "-50"}) {
    const Ran run = run_case("far_plane", {std::string("steps.0.move.0.translate=[0, 0, ") + way + "]"});
    EXPECT_EQ(run.status, 1) << way << run.out;
    EXPECT_NE(run.text("summary.json").find("Give the step more increments"), std::string::npos) << way;
  }
}

// Deeper than the search looks, and still in contact: the penalty is too small for it, which is told.
TEST(FarPlane, IsFollowedHoweverDeep) {
  const Ran run = run_case("far_plane", {"steps.0.move.0.translate=[0, 0, -12.5]"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(probe(run, "push"), 1e4);
  EXPECT_LT(probe(run, "top"), .1);
  EXPECT_NE(run.summary()["warnings"].dump().find("of the thinner layer"), std::string::npos);
}

}  // namespace
}  // namespace bulbus::test
