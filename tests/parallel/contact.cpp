// Contacts press the same nodes with the same force however many ranks hold them.
#include "contact/operation.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

Mesh block(const std::string& name, const Point& lower, const Point& upper, int n, int nz) {
  Mesh mesh = generate(BlockShape{.lower = lower, .upper = upper, .nx = n, .ny = n, .nz = nz, .region = name});
  std::map<std::string, std::vector<Quad>> surfaces;
  for (const auto& [side, faces] : mesh.surfaces) surfaces[name + " " + side] = faces;
  mesh.surfaces = surfaces;
  return mesh;
}

ContactSpec contact(const std::string& name, const std::string& slave, const std::string& master) {
  ContactSpec c;
  c.name = name, c.slave = slave, c.master = master;
  return c;
}

/// A soft block pressed onto a stiffer one whose nodes do not match, then a ball into the side of that one.
Scene two_blocks_and_a_ball() {
  Scene scene{block("low", {0, 0, 0}, {1, 1, .5}, 4, 2), {}};
  append(scene.mesh, block("high", {0, 0, .52}, {.8, .8, 1}, 3, 2));
  Model& m = scene.model;
  m.regions = {{"low", neo_hooke(.5)}, {"high", neo_hooke(.2)}};
  m.symmetry = {"x", "y"};
  m.fix.push_back({"low zmin", {"x", "y", "z"}});
  m.rigid_bodies["ball"].sphere = SphereShape{.center = {2, .4, .35}, .radius = .5};
  m.contacts = {contact("blocks", "high zmin", "low zmax"), contact("ball", "low xmax", "ball")};
  StepSpec press = step("press", 2), poke = step("poke");
  DisplaceSpec d = displace("high zmax");
  d.z = "-0.08";
  press.displace = {d};
  poke.displace = {d};
  MoveSpec move;
  move.body = "ball", move.from = "touch", move.translate = {-.05, 0, 0};
  poke.move = {move};
  m.steps = {press, poke};
  for (const auto& [kind, set] : {std::pair{"reaction", "high zmax"}, {"displacement", "low xmax"}, {"mises", ""}}) {
    ProbeSpec p;
    p.name = p.kind = kind, p.set = set, p.statistic = "max";
    m.probes.push_back(p);
  }
  return scene;
}

struct Pressed : Trial {
  std::shared_ptr<Operation> operation;
  explicit Pressed(const Scene& scene, const Comm& c = {}) : Trial(scene, c), operation(Operation::attach(problem, scene.mesh)) {
    settings.newton = tight(1e-10);
  }
  std::vector<double> figures() { return ProbeSet(problem).values(problem, state); }
  int pairs(const std::string& name) const { return comm.sum(operation->contact(name, "").term->figures(state).pairs); }
};

TEST(Contact, IsTheSameOnAnyNumberOfRanks) {
  const Scene scene = two_blocks_and_a_ball();
  Pressed alone(scene, Comm(MPI_COMM_SELF));
  alone.direct();
  ASSERT_TRUE(alone.report.converged) << alone.report.reason;
  const auto expected = alone.figures();
  for (bool direct : {true, false}) {
    Pressed together(scene);
    direct ? together.direct() : together.iterative();
    ASSERT_TRUE(together.report.converged) << together.report.reason;
    const auto found = together.figures();
    double worst = 0;
    for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, relative(found[i], expected[i]));
    EXPECT_LT(worst, 1e-6);
    for (const char* name : {"blocks", "ball"}) {
      EXPECT_GT(alone.pairs(name), 0) << name;
      EXPECT_EQ(together.pairs(name), alone.pairs(name)) << name;
    }
    measured("two blocks and a ball, {} ranks, {}, against direct alone: {} and {} active pairs, worst probe {:.0e}; {} increments ({}), {} Newton iterations ({}), {} Krylov",
             together.comm.size(), direct ? "direct" : "iterative", together.pairs("blocks"), together.pairs("ball"), worst, together.report.increments,
             alone.report.increments, together.report.newton_iterations, alone.report.newton_iterations, together.report.krylov_iterations);
  }
}

}  // namespace
}  // namespace bulbus
