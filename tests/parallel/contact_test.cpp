// Contacts press the same nodes with the same force however many ranks hold them.
#include "contact/interaction_figures.hpp"
#include "core/base/error.hpp"
#include "tests/verify/two_blocks.hpp"

namespace bulbus {
namespace {

/// A soft block pressed onto a stiffer one whose nodes do not match, then a ball into the side of that one.
Scene two_blocks_and_a_ball() {
  Scene scene{named_block("low", {0, 0, 0}, {1, 1, .5}, 4, 2), {}};
  // not square: on the diagonals of the master's faces nodes have two equilibria, each the image of the other
  append(scene.mesh, named_block("high", {0, 0, .52}, {.8, .7, 1}, 3, 2));
  Model& m = scene.model;
  m.regions = {{"low", neo_hooke(.5)}, {"high", neo_hooke(.2)}};
  m.symmetry = {"x", "y"};
  m.fix.push_back({"low zmin", {"x", "y", "z"}});
  m.rigid_bodies["ball"].sphere = SphereShape{.center = {2, .4, .35}, .radius = .5};
  m.contacts = {contact_between("blocks", "high zmin", "low zmax"),
                contact_between("ball", "low xmax", "ball")};
  StepSpec press = step("press", 2), poke = step("poke");
  DisplaceSpec d = displace("high zmax");
  d.z = "-0.08";
  press.displace = {d};
  poke.displace = {d};
  poke.move = {shift("ball", {-.05, 0, 0}, "touch")};
  m.steps = {press, poke};
  for (const auto& [kind, set] :
       {std::pair{"reaction", "high zmax"}, {"displacement", "low xmax"}, {"mises", ""}}) {
    ProbeSpec p;
    p.name = p.kind = kind, p.set = set, p.statistic = "max";
    m.probes.push_back(p);
  }
  return scene;
}

void expect_the_same_on_any_number_of_ranks(const Scene& scene) {
  ContactTrial alone(scene, Comm(MPI_COMM_SELF));
  alone.direct();
  ASSERT_TRUE(alone.report.converged) << alone.report.reason;
  const auto expected = ProbeSet(alone.problem).values(alone.problem, alone.state);
  for (bool direct : {true, false}) {
    ContactTrial together(scene);
    direct ? together.direct() : together.iterative();
    ASSERT_TRUE(together.report.converged) << together.report.reason;
    const auto found = ProbeSet(together.problem).values(together.problem, together.state);
    EXPECT_EQ(found.size(), scene.model.probes.size());
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) worst = worse(worst, relative(found[i], expected[i]));
    EXPECT_LT(worst, 1e-6);
    for (const char* name : {"blocks", "ball"}) {
      EXPECT_GT(alone.pairs(name), 0) << name;
      EXPECT_EQ(together.pairs(name), alone.pairs(name)) << name;
    }
    measured(
        "two blocks and a ball, {} ranks, {}, against direct alone: {} and {} active pairs, worst probe "
        "{:.0e}; {} increments ({}), {} Newton iterations ({}), {} Krylov",
        together.comm.size(), direct ? "direct" : "iterative", together.pairs("blocks"),
        together.pairs("ball"), worst, together.report.increments, alone.report.increments,
        together.report.newton_iterations, alone.report.newton_iterations, together.report.krylov_iterations);
  }
}

TEST(Contact, IsTheSameOnAnyNumberOfRanks) {
  expect_the_same_on_any_number_of_ranks(two_blocks_and_a_ball());
}

TEST(Contact, OfBothWaysIsTheSameOnAnyNumberOfRanks) {
  Scene scene = two_blocks_and_a_ball();
  scene.model.contacts[0].two_way = true;
  expect_the_same_on_any_number_of_ranks(scene);
  ContactTrial alone(scene, Comm(MPI_COMM_SELF)), together(scene);
  alone.direct(), together.direct();
  Snapshot one(alone.problem, alone.state), many(together.problem, together.state);
  const ContactStanding expected = standing(alone.interactions->contact("blocks", ""), one),
                        found = standing(together.interactions->contact("blocks", ""), many);
  EXPECT_EQ(found.touching, expected.touching);
  EXPECT_LT(relative(found.pressure, expected.pressure), 1e-6);
  const Vec3<double> push =
      probes::total(together.problem, on_master(together.interactions->contact("blocks", ""), many), "whole")
          .force;
  EXPECT_LT(relative(-push[2], std::abs(ProbeSet(alone.problem).values(alone.problem, alone.state)[0])), 1e-6)
      << "held from below";
}

// Each node lies on an edge or a corner of the other side: GMRES leaves a little of the residual, and no pair
// may make more of it.
TEST(Contact, OfMatchingNodesIsIterativelyAsDirectly) {
  for (double penalty : {100., 1e6}) {
    ContactTrial alone(two_blocks(3, 3, penalty), Comm(MPI_COMM_SELF));
    alone.direct();
    ASSERT_TRUE(alone.report.converged) << alone.report.reason;
    ContactTrial together(two_blocks(3, 3, penalty));
    together.settings.linear.fallback = Fallback::none;
    together.iterative();
    ASSERT_TRUE(together.report.converged) << together.report.reason;
    EXPECT_LT(relative(together.force("joint")[2], alone.force("joint")[2]), 1e-6) << penalty;
    EXPECT_LE(together.report.newton_iterations, 8 * together.report.increments) << penalty;
    EXPECT_EQ(together.report.cuts, 0) << penalty;
  }
}

// The upper block is sunk into the lower one, deepest by its corner (0.8, 0.7).
TEST(Contact, CountsAnOverlapAtTheStartOverAllRanks) {
  Scene scene = two_blocks_and_a_ball();
  for (Point& p : scene.mesh.points)
    if (p[2] >= .52) p[2] -= .03 + .01 * (p[0] + p[1]);
  const auto refusal = [&](const Comm& comm) -> std::string {
    Problem problem(scene.mesh, scene.model, comm);
    const auto interactions = Interactions::attach(problem, scene.mesh);
    try {
      problem.begin_step(0, problem.initial_state());
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "accepted";
  };
  const std::string alone = refusal(Comm(MPI_COMM_SELF));
  EXPECT_NE(
      alone.find(
          "starts with 16 of its points inside 'low zmax', the deepest by 0.025 mm at (0.8, 0.7, 0.475)"),
      std::string::npos)
      << alone;
  EXPECT_EQ(refusal(Comm()), alone);
}

}  // namespace
}  // namespace bulbus
