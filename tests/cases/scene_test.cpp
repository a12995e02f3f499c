// Scenes that are wrong, states in which no body can be, and failures that teach.
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

bool warns(const Ran& run, const std::string& part) {
  const auto summary = run.summary();
  for (const auto& warning : summary["warnings"])
    if (warning.get<std::string>().find(part) != std::string::npos) return true;
  return false;
}

// `check` writes to the screen.
std::string said_by_check(const std::string& folder, const std::vector<std::string>& set = {}) {
  testing::internal::CaptureStdout();
  const Ran run = run_case(folder, set, "s.yaml", "check");
  EXPECT_EQ(run.status, 0) << run.err;
  return testing::internal::GetCapturedStdout();
}

TEST(NotANumber, IsRefusedWithFormulaPlaceAndProgress) {
  for (const char* command : {"check", "run"}) {
    expect_refused(run_case("not_a_number", {}, "div0.yaml", command),
                   {"div0.yaml:9: ", "steps.0.displace.0.x", "1/0", "s = 0", "infinite"});
    expect_refused(run_case("not_a_number", {}, "nanf.yaml", command),
                   {"nanf.yaml:9: ", "steps.0.displace.0.x", "sqrt(-1)", "not a number"});
  }
}

TEST(NotANumber, IsRefusedWhereverAFormulaStands) {
  const auto with = [](const std::string& set) { return run_case("not_a_number", {set}, "div0.yaml"); };
  expect_refused(with("steps.0.displace.0.x=log(Y-2)"), {"not a number", "Y = "});
  expect_refused(with("steps.0.displace.0.x=1/(s-0.5)"), {"s = 0.5"});
  for (const char* word : {".nan", ".inf", "nan", "inf", "1e999", "1e999*s"})
    EXPECT_EQ(with(std::string("steps.0.displace.0.x=") + word).status, 2) << word;
  const std::string load = "steps.0.loads=[{surface: zmax, pressure: \"";
  expect_refused(run_case("not_a_number", {"steps.0.displace.0.x=0.1", load + "log(-s)\"}]"}, "div0.yaml"),
                 {"steps.0.loads.0.pressure", "log(-s)"});
  expect_refused(run_case("not_a_number", {"steps.0.displace.0.x=0.1", load + "0.001*X\"}]"}, "div0.yaml"),
                 {"depends on X"});
  expect_refused(run_case("wrong_unit", {"steps.0.pressures.inside=0/0*s"}),
                 {"steps.0.pressures.inside", "not a number"});
}

// Between the places in s at which it is looked at when a step begins.
TEST(NotANumber, IsRefusedDuringAStep) {
  expect_refused(
      run_case("not_a_number", {"steps.0.displace.0.x=0.1*s/(abs(s-0.25)>1e-9)", "steps.0.increments=4"},
               "div0.yaml"),
      {"s = 0.25", "not a finite number"});
}

const std::string column = R"(
mesh: {block: {upper: [1, 1, 4], nx: 2, ny: 2, nz: 4, region: soft}}
regions: {soft: {c10: 50 kPa}}
fix: [{set: zmin}]
steps: [{name: one, increments: 4, displace: [{set: xmax, x: '0.1*sin(2*pi*s)'}]}]
)";

// They agree half way through the step and at its end.
TEST(Prescriptions, ThatContradictInBetweenAreRefused) {
  expect_refused(run_scene(column), {"steps.0.displace", "over-constrained", "two displacements"});
}

// The soft ends feel the rounding of the middle, in a motion without stress.
TEST(StiffMiddle, IsTurnedWithItsSoftEnds) {
  const Ran run = run_case("stiff_middle");
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST(Reaction, OfARigidRegionAloneIsRefused) {
  expect_refused(
      run_case("stiff_middle", {"regions.mid={rigid: true}", "probes=[{name: R, kind: reaction, set: mid}]"}),
      {"'mid'", "no support"});
}

// Held against the rest of the block, and where nothing pulls.
TEST(PointSupport, IsToldOfWhereItBears) {
  const std::string block = R"(
mesh:
  block: {nx: 4, ny: 4, nz: 4}
  sets: {corner: "X > .99 && Y > .99 && Z > .99"}
regions: {block: {c10: 50 kPa}}
fix: [{set: zmin}]
steps: [{name: pull, increments: 2, displace: [{set: corner, x: .2}]}]
)";
  const Ran pulled = run_scene(block);
  ASSERT_EQ(pulled.status, 0) << pulled.err;
  EXPECT_TRUE(warns(pulled, "the only node of 'corner'"));
  const Ran slack = run_scene(block, {"steps.0.displace.0.x=.001"});
  ASSERT_EQ(slack.status, 0) << slack.err;
  EXPECT_FALSE(warns(slack, "the only node of"));
}

TEST(Sewing, OverABodyThatIsKeptAwayIsRefused) {
  expect_refused(run_scene(R"(
mesh: {shell: {inner: 10, outer: 12, n: 2, layers: 1, part: half}}
regions: {shell: {c10: 80 kPa}}
symmetry: [x]
fix: [{set: inner}]
rigid_bodies:
  tire: {tire: {width: 4, crown: 2, inner_radius_of_curvature: 12, radius: 12.3, from: 0, to: 30}, direction: [0, -1, 0]}
contacts: [{name: t, slave: outer, master: tire}]
sutures: {string: {body: tire, surface: outer, pair: {azimuth: 0, spacing: 8}}}
steps:
  - {name: sew, sew: {string: 0.02}}
  - {name: press, move: [{body: tire, from: touch, close: 0.05}]}
)"),
                 {"steps.0.sew.string", "step 2", "from: touch"});
}

TEST(MergeKey, IsRead) {
  const Ran run = run_case("not_a_number", {}, "merge.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "F"), 105.556, 1e-2);  // 2 c10 (1.5 − 1/1.5²)
}

TEST(DecimalComma, IsRefusedOutsideOfFunctions) {
  expect_refused(run_case("decimal_comma"), {"s.yaml:8: ", "steps.0.displace.0.z", "0,1", "write 0.1"});
  for (const char* formula : {"2*(0,5)", "\"0,1*s\"", "sin(0,5)", "0,1 mm"})
    expect_refused(run_case("decimal_comma", {std::string("steps.0.displace.0.z=") + formula}),
                   {"write 0.1"});
  expect_refused(run_case("decimal_comma", {"regions.block.c10=0,05"}), {"write 0.05"});
}

TEST(DecimalComma, IsNoneBetweenArguments) {
  const Ran run = run_case("decimal_comma", {"steps.0.displace.0.z=max(0.1*s, min(0, s)) + 0*atan2(s, 1)"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "uz"), .1, 1e-9);
}

TEST(WrongUnit, OfAPressureIsAskedBack) {
  for (const char* command : {"check", "run"})
    expect_refused(
        run_case("wrong_unit", {}, "s.yaml", command),
        {"15 MPa is 93.8 times the shear modulus", "did you mean `15 mmHg`?", "15 MPa` if that is meant"});
  expect_refused(run_case("wrong_unit", {"steps.0.pressures.inside=2 mmHg",
                                         "steps.0.loads=[{surface: outer, pressure: -20}]"}),
                 {"steps.0.loads.0.pressure"});
  EXPECT_EQ(run_case("wrong_unit", {"steps.0.pressures.inside=15 mmHg"}).status, 0);
  EXPECT_EQ(run_case("wrong_unit", {"steps.0.pressures.inside=0.002"}).status, 0);
  EXPECT_EQ(run_case("wrong_unit", {"steps.0.pressures.inside=15 MPa"}, "s.yaml", "check").status, 0);
}

TEST(WrongUnit, OfAStiffnessIsToldOf) {
  for (const auto& [c10, told] : {std::pair{"50000", true}, {"50000 Pa", false}}) {
    const Ran run = run_case("wrong_unit", {"steps.0.pressures.inside=15 mmHg",
                                            std::string("regions={shell: {c10: ") + c10 + "}}"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(warns(run, "as metals have"), told) << c10;
  }
}

TEST(WrongUnit, OfADisplacementOrAnAngleIsAskedBack) {
  expect_refused(run_case("decimal_comma", {"steps.0.displace.0.z=100"}),
                 {"100 mm is 20.4 times the diagonal", "did you mean `100 um`?"});
  EXPECT_EQ(run_case("decimal_comma", {"steps.0.displace.0.z=100 um"}).status, 0);
  expect_refused(run_case("decimal_comma", {"steps.0.displace.0.rotate={angle: 30}"}),
                 {"is it in degrees?", "'30 deg'"});
}

TEST(GivenPressure, OfALiquidThatIsEnclosedInTheSameStepIsRefused) {
  expect_refused(run_case("limit_point", {"steps.0.enclose=[inside]"}),
                 {"steps.0.pressures.inside", "enclosed in this step", "a step before"});
}

TEST(ReactionAcrossSymmetry, IsToldAndTheDrawnPartIsGiven) {
  const Ran whole = run_case("reaction_across_symmetry");
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_TRUE(warns(whole, "component x of probe 'F' is across the plane of symmetry x"));
  EXPECT_EQ(probe(whole, "F"), 0);
  const Ran part = run_case("reaction_across_symmetry", {"probes.0.of=part"});
  ASSERT_EQ(part.status, 0) << part.err;
  EXPECT_NEAR(probe(part, "F"), 175, .02);  // 2 c10 (2 − 1/4)
  EXPECT_FALSE(warns(part, "probe 'F'"));
  const Ran y_and_z =
      run_case("reaction_across_symmetry", {"symmetry=[y, z]", "fix=[{set: xmin, directions: [x]}]"});
  EXPECT_NEAR(probe(y_and_z, "F"), 700, .1);
  EXPECT_FALSE(warns(y_and_z, "probe 'F'"));
}

TEST(ReactionAcrossSymmetry, OfMomentsGoesTheOtherWay) {
  const auto moment = [](const std::string& component) {
    return said_by_check("reaction_across_symmetry",
                         {"symmetry=[x]", "fix=[{set: ymin, directions: [y, z]}]", "probes.0.kind=moment",
                          "probes.0.unit=mN mm", "probes.0.component=" + component});
  };
  EXPECT_EQ(moment("x").find("probe 'F'"), std::string::npos);
  EXPECT_NE(moment("y").find("component y of probe 'F' is along the plane of symmetry x"), std::string::npos);
  expect_refused(run_case("reaction_across_symmetry",
                          {"probes.0.of=part", "probes.0.kind=displacement", "probes.0.unit=mm"}),
                 {"probes.0.of"});
}

TEST(FixedVolume, WithoutRoomIsRefusedWithTheVolume) {
  for (const char* command : {"check", "run"})
    expect_refused(run_case("fixed_volume", {}, "s.yaml", command),
                   {"region 'block'", "0.1 mm3 have no place"});
  expect_refused(run_case("fixed_volume", {"steps.0.displace.0.x=0.05"}), {"0.05 mm3 are missing"});
  // held at last: in the second step only
  expect_refused(run_case("fixed_volume",
                          {"steps=[{displace: [{set: xmax, x: 0}]}, {displace: [{set: xmax, x: -0.2}]}]"}),
                 {"steps.1", "0.2 mm3"});
}

TEST(FixedVolume, KeepsItsMeanPressureWithEitherSolver) {
  double reaction[2];
  int k = 0;
  for (const char* method : {"direct", "iterative"}) {
    const Ran run = run_case("fixed_volume/still", {std::string("solver.linear.method=") + method});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(warns(run, "fix the volume of region 'block'"));
    reaction[k++] = probe(run, "top");
    EXPECT_NEAR(probe(run, "top") + probe(run, "bottom"), 0, 1e-3);
  }
  EXPECT_NEAR(reaction[0], reaction[1], 1e-3 * (1 + std::abs(reaction[1])));
}

TEST(FixedVolume, IsNoneWhereAFaceIsFree) {
  const Ran run = run_case(
      "fixed_volume/still",
      {"fix=[{set: xmin, directions: [x]}, {set: ymin, directions: [y]}, {set: zmin, directions: [z]}]"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(warns(run, "fix the volume"));
}

TEST(UnstableMaterial, IsToldBeforeAndAfter) {
  EXPECT_NE(said_by_check("unstable_material").find("loses stability"), std::string::npos);
  EXPECT_EQ(said_by_check("unstable_material", {"regions.block.c01=10 kPa"}).find("loses stability"),
            std::string::npos);
  const Ran run = run_case("unstable_material", {"solver.linear.method=direct"});
  EXPECT_TRUE(warns(run, "the law of region 'block' loses stability"));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "Fx"), -102.83, .01);
}

TEST(LimitPoint, IsNamedWithTheLastStablePressure) {
  const Ran run = run_case("limit_point", {"solver.linear.method=direct"});
  ASSERT_EQ(run.status, 1) << run.err;
  const std::string text = run.summary()["diagnosis"];
  for (const char* part : {"limit point", "inside", "enclose", "add"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  EXPECT_NEAR(probe(run, "P"), 11.8, .05);
  EXPECT_LT(probe(run, "r"), 14.6);
}

TEST(LimitPoint, IsPassedByVolume) {
  const Ran run = run_case("limit_point", {"solver.linear.method=direct"}, "by_volume.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(run.summary().contains("diagnosis"));
}

// π c10 (angle / height) R⁴ N·mm: places before and after a whole turn are the same, the states are not.
TEST(WholeTurn, TwistsInAnyNumberOfIncrements) {
  for (const char* set : {"steps.0.increments=1", "steps.0.increments=10", "solver.accuracy=fast"}) {
    const Ran run = run_case("whole_turn", {set});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(probe(run, "moment"), .1234, .004) << set;
  }
}

// The search for the unloaded reference knows the first step's end, to which all of a turn at once would lead
// the short way.
TEST(WholeTurn, TwistsBehindAnUnloadedReference) {
  const std::string loads = "loads=[{surface: side, pressure: 1 Pa}]";
  const Ran run =
      run_case("whole_turn", {"reference={loads: [{surface: side, pressure: 1 Pa}]}", "steps.0." + loads});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "moment"), .1234, .004);
}

// The volume that is added is less than what may be missing of the liquid's law.
TEST(SmallLoads, AreNotPassedOver) {
  const Ran run = run_scene(R"yaml(mesh: {shell: {inner: 10, outer: 10.5, n: 4, layers: 1, part: octant}}
regions: {shell: {c10: 50 kPa}}
liquids: {filling: {surface: inner}}
symmetry: [x, y, z]
steps:
  - {name: fill, pressures: {filling: 2 kPa}}
  - {name: inject, enclose: [filling], add: {filling: 0.0003}}
  - {name: more, add: {filling: 0.03}}
probes:
  - {name: P, kind: pressure, liquid: filling, unit: Pa}
)yaml",
                            {});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto fields_of = [](const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> fields;
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    return fields;
  };
  const auto lines = run.lines("history.csv");
  const auto names = fields_of(lines.at(0));
  const auto column = std::ranges::find_if(names, [](const std::string& n) { return n.starts_with("P"); });
  ASSERT_NE(column, names.end());
  std::vector<double> P;  // at the ends of the steps
  for (std::size_t k = 1; k < lines.size(); ++k)
    P.push_back(std::stod(fields_of(lines[k]).at(column - names.begin())));
  ASSERT_GE(P.size(), 3u);
  const std::size_t n = P.size();
  // The step before leaves up to the criterion, 1e-7 of the pressure; the small change makes up for it as
  // well.
  EXPECT_NEAR(P[n - 2] - P[n - 3], 8.5204e-4, 1e-7 * P[n - 3]);  // Pa, by criteria of 1e-12
  EXPECT_NEAR(P[n - 1] - P[n - 2], 8.5203e-2, 1e-2 * 8.5203e-2);
}

// A comparison with what is not a number is false, and the set would lack these nodes in silence.
TEST(NotANumber, IsRefusedInPartsOfConditions) {
  const auto checked = [](const std::string& condition) {
    return run_case("whole_turn", {"mesh.sets={a: \"" + condition + "\"}"}, "s.yaml", "check");
  };
  expect_refused(checked("sqrt(Z - 1) < 2"), {"mesh.sets.a", "is not a number at", "? "});
  EXPECT_EQ(checked("Z > 1 ? sqrt(Z - 1) < 2 : 0").status, 0);
  EXPECT_EQ(checked("sqrt(Z + 1) < 2").status, 0);
}

std::string shipped(const std::string& name) {
  std::ifstream in(std::string(BULBUS_DATA) + "/scenes/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(IdleKeys, OfBodiesAndSuturesAreRefused) {
  expect_refused(run_scene(shipped("band.yaml"),
                           {"mesh.eye.n=4", "rigid_bodies.band.band.stiffness=0.5", "steps.1.move=[]"}),
                 {"rigid_bodies.band.band.stiffness", "no step shortens the band"});
  expect_refused(run_scene(shipped("suture.yaml"), {"sutures.string.bite=1000"}),
                 {"sutures.string.bite", "all of the surface"});
}

TEST(Drained, MoreThanThereIsIsRefused) {
  const std::string text = shipped("sphere_liquid.yaml");
  const Ran run = run_scene(text, {"mesh.shell.n=2", "steps.1.add={inside: -8 mL}"});
  EXPECT_EQ(run.status, 1) << run.err;
  const std::string reason = run.summary()["reason"];
  for (const char* part : {"steps.1.add.inside", "8000 mm3 are drained"})
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
  EXPECT_EQ(run.summary()["diagnosis"], "Drain less than there is.");
  EXPECT_EQ(run_scene(text, {"mesh.shell.n=2", "steps.1.add={inside: -4.2 mL}"}, "check").status, 0)
      << "as much as is drawn, but not as is there after the first step";
}

TEST(IdleStatistic, IsRefusedWhereTheFigureIsNone) {
  const auto probed = [](const std::string& probe) {
    return run_case("unnamed_steps", {"probes=[{name: a, " + probe + "}]"});
  };
  expect_refused(probed("kind: mises, statistic: mean"), {"probes.0.statistic", "no effect", "percentile"});
  expect_refused(probed("kind: reaction, set: xmax, statistic: max"), {"probes.0.statistic", "no effect"});
  expect_refused(probed("kind: reaction, set: xmax, statistic: mean"), {"probes.0.statistic", "no effect"});
  const Ran run = probed("kind: volume_ratio, statistic: mean}, {name: b, kind: mises, statistic: max");
  EXPECT_EQ(run.status, 0) << run.err;
  std::ostringstream out, err;
  EXPECT_EQ(command_line({"check", run.folder / "out" / "resolved.yaml"}, Comm(MPI_COMM_SELF), out, err), 0)
      << err.str();
}

// A ring of radius 1 mm that is carried round by 30 degrees within the step.
TEST(TurnedRadial, IsTold) {
  const Ran run = run_case("turned_radial");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(probe(run, "ur"), .05);  // mm, where 0 is prescribed
  EXPECT_NE(run.summary()["warnings"].dump().find("nodes of 'ring' have turned about the axis"),
            std::string::npos);
  const Ran little = run_case("turned_radial", {"steps.0.displace.1.rotate.angle=2 deg"});
  ASSERT_EQ(little.status, 0) << little.err;
  EXPECT_EQ(little.text("summary.json").find("have turned"), std::string::npos);
}

// A formula in Z that divides two cells as they are drawn, 2 mm high; unloaded they are lower.
TEST(FibresOfTheDrawn, AreThoseOfTwoRegions) {
  const Ran formula = run_case("fibres_of_the_drawn", {}, "form.yaml"),
            regions = run_case("fibres_of_the_drawn", {}, "two.yaml");
  ASSERT_EQ(formula.status, 0) << formula.err;
  ASSERT_EQ(regions.status, 0) << regions.err;
  EXPECT_NEAR(probe(formula, "zpos"), probe(regions, "zpos"), 1e-6);
}

TEST(FibreAngle, WithoutAUnitIsAskedFor) {
  const std::string fibres = "regions.block.fibres={k1: 0.05, k2: 1, families: [{angle: ";
  expect_refused(run_case("fibres_of_the_drawn", {fibres + "10}]}"}, "form.yaml"),
                 {"angle", "'10 deg' or '10 rad'"});
  EXPECT_EQ(run_case("fibres_of_the_drawn", {fibres + "10 deg}]}"}, "form.yaml").status, 0);
}

}  // namespace
}  // namespace bulbus::test
