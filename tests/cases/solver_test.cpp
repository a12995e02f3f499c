// Systems on which GMRES stagnated: the iterative solver goes wherever the direct one goes.
#include "tests/cases/run_case.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus::test {
namespace {

struct Result {
  int status;
  nlohmann::json summary;
  std::string log;
};

Result result_of(const std::string& folder, const std::vector<std::string>& set) {
  const Ran run = run_case(folder, set);
  EXPECT_NE(run.status, 2) << run.err;
  return {run.status, run.summary(), run.text("run.log")};
}

struct Both {
  Result iterative, direct;
};

// `of_gmres`: settings of the iterative solver alone.
Both run_both(const std::string& folder, const std::vector<std::string>& set = {},
              const std::vector<std::string>& of_gmres = {}) {
  Both both;
  for (Result* r : {&both.iterative, &both.direct}) {
    auto all = set;
    all.push_back(std::string("solver.linear.method=") + (r == &both.direct ? "direct" : "iterative"));
    if (r == &both.iterative) all.insert(all.end(), of_gmres.begin(), of_gmres.end());
    *r = result_of(folder, all);
    EXPECT_EQ(r->status, 0) << r->summary["reason"];
  }
  return both;
}

// Every probe to 1e-6 of its largest, and no more than a fifth more increments.
void expect_same(const Both& both) {
  const auto &found = both.iterative.summary, &expected = both.direct.summary;
  ASSERT_FALSE(found["probes"].empty());
  double scale = 0;
  for (const auto& [name, value] : expected["probes"].items())
    scale = std::max(scale, std::abs(value.get<double>()));
  for (const auto& [name, value] : not_empty(expected["probes"]).items()) {
    const double size = std::max(std::abs(value.get<double>()), 1e-6 * scale);
    EXPECT_NEAR(found["probes"][name].get<double>(), value.get<double>(), 1e-6 * size) << name;
  }
  EXPECT_EQ(found["unstable_increments"], expected["unstable_increments"]);
  EXPECT_LE(found["totals"]["increments"].get<double>(),
            1.2 * expected["totals"]["increments"].get<double>());
}

TEST(Indefinite, IsPulledToTwiceItsLengthInOneIncrement) {
  const Both both = run_both("indefinite");
  expect_same(both);
  EXPECT_EQ(both.iterative.summary["totals"]["cuts"], 0);
}

// Other lengths, meshes and laws meet other indefinite tangents.
TEST(Indefinite, IsPulledAndPressedOtherwise) {
  for (const std::vector<std::string>& set :
       {std::vector<std::string>{"steps.0.displace.0.x=2"},
        {"steps.0.displace.0.x=1.5", "mesh.block.nx=3", "mesh.block.ny=3", "mesh.block.nz=3"},
        {"steps.0.displace.0.x=-0.5", "mesh.block.ny=4"}})
    expect_same(run_both("indefinite", set));
}

TEST(UnstableMaterial, IsFollowedBeyondItsLimitAndTold) {
  const Both both = run_both("unstable_material");
  expect_same(both);
  EXPECT_NEAR(both.iterative.summary["probes"]["Fx"].get<double>(), -102.83, .01);
  EXPECT_NE(both.iterative.log.find("not a stable equilibrium"), std::string::npos);
  for (const Result& r : {both.iterative, both.direct})
    EXPECT_NE(r.summary["warnings"].dump().find("not a stable equilibrium"), std::string::npos);
}

// Twelve iterations are too few now and then.
TEST(UnstableMaterial, IsSolvedByMumpsWhereGmresFails) {
  const Both both = run_both("unstable_material", {}, {"solver.linear.max_iterations=12"});
  expect_same(both);
  EXPECT_GT(both.iterative.summary["direct_solves"], 0);
  EXPECT_NE(both.iterative.log.find("by MUMPS (GMRES: iterations exhausted)"), std::string::npos);
  const Result alone =
      result_of("unstable_material", {"solver.linear.max_iterations=12", "solver.linear.fallback=none"});
  EXPECT_EQ(alone.status, 1);
  EXPECT_NE(alone.summary["reason"].get<std::string>().find("GMRES"), std::string::npos);
  EXPECT_EQ(alone.summary["direct_solves"], 0);
}

// Its nine hexahedra carry pressures of alternating sign, 48 times their shear modulus: an unstable
// equilibrium, in which the chamber that was filled has the lower pressure.
TEST(Membrane, OfTooFewHexahedraIsToldOf) {
  const Ran coarse = run_case("membrane", {"solver.linear.method=direct"});
  EXPECT_EQ(coarse.status, 0) << coarse.err;
  EXPECT_LT(probe(coarse, "one"), probe(coarse, "two"));
  const std::string told = coarse.summary()["warnings"].dump();
  EXPECT_NE(told.find("region 'membrane' alternates"), std::string::npos) << told;
  const Ran alone = run_case("membrane", {"solver.linear.fallback=none", "solver.stepping.minimum=0.1"});
  EXPECT_EQ(alone.status, 1);
  EXPECT_NE(alone.summary()["diagnosis"].get<std::string>().find("mesh: {refine: 1}"), std::string::npos);
  const Ran fine = run_case("membrane", {"solver.linear.fallback=none", "mesh.refine=1"});
  EXPECT_EQ(fine.status, 0) << fine.err;
  EXPECT_GT(probe(fine, "one"), probe(fine, "two"));
  EXPECT_TRUE(fine.summary()["warnings"].empty()) << fine.summary()["warnings"];
}

// The block leaves the symmetric branch that the direct solver stays on: more increments, the same end.
TEST(DeepOverlap, IsResolved) {
  const Result run = result_of("deep_overlap", {});
  EXPECT_EQ(run.status, 0) << run.summary["reason"];
  EXPECT_NEAR(run.summary["probes"]["push"].get<double>(), 2340, 1);
}

// Changes that the criteria hardly see, or not at all: figures of them are those of the direct solver.
TEST(SmallChange, IsSolvedAsPreciselyAsALargeOne) {
  struct Change {
    std::string file, probe, size;
    double apart;  // the smallest are of the size of what the step before may leave
  };
  for (const Change& c : {Change{"injection.yaml", "dp", "steps.1.add.inside=0.01 uL", 2e-3},
                          {"injection.yaml", "dp", "steps.1.add.inside=4e-5 uL", .1},
                          {"force.yaml", "ux", "steps.1.loads.0.force=[5e-8,0,0]", 3e-3},
                          {"force.yaml", "ux", "steps.1.loads.0.force=[1e-9,0,0]", .2}}) {
    const Ran iterative = run_case("small_change", {c.size}, c.file);
    const Ran direct = run_case("small_change", {c.size, "solver.linear.method=direct"}, c.file);
    ASSERT_EQ(iterative.status, 0) << iterative.err;
    ASSERT_EQ(direct.status, 0) << direct.err;
    const double expected = probe(direct, c.probe);
    EXPECT_GT(expected, 0) << c.size;
    EXPECT_NEAR(probe(iterative, c.probe), expected, c.apart * expected) << c.size;
  }
}

}  // namespace
}  // namespace bulbus::test
