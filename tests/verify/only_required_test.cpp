// What a scene leaves out costs nothing: no term, no unknown, no allocation, no search, no hexahedron in the
// kernels.
#include "contact/interactions.hpp"
#include "tests/support/allocations.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

/// The filled shell at its second step, with its bars, its rigid cap and its liquid or without some of them.
struct Parts {
  bool bars = true, cap = true, liquid = true;
};

Scene shell(const Parts& parts) {
  Scene scene = filled_shell("octant");
  Model& m = scene.model;
  if (!parts.bars) m.bars.clear(), scene.mesh.bars.clear();
  if (!parts.cap) m.regions["cap"] = neo_hooke(.5);
  if (!parts.liquid) {
    m.liquids.clear();
    for (StepSpec& s : m.steps) s.pressures.clear(), s.enclose.clear();
  }
  return scene;
}

/// A linearised problem and what its parts hold.
struct Linearised {
  Problem problem;
  State state;
  SharedSystem system;
  std::optional<CoupledOperator> A;
  std::vector<double> x, y;

  explicit Linearised(const Scene& scene)
      : problem(scene.mesh, scene.model, Comm()), state(problem.initial_state()) {
    for (int k = 0; k < static_cast<int>(scene.model.steps.size()); ++k) {
      if (k > 0) problem.end_step();
      problem.begin_step(k, state), problem.set_progress(1, state);
    }
    system = std::make_shared<const CoupledSystem>(problem, LinearSettings{}, state, problem.residual(state));
    x.assign(system->size(), 1e-3), y.assign(system->size(), 0);
    A.emplace(system);
    apply(), apply_displacement();  // work space is made once
  }
  void apply() { A->apply(x, y); }
  void apply_displacement() {
    const int primal = system->layout().primal();
    system->apply_displacement(std::span(x).first(primal), std::span(y).first(primal));
  }
  long long in_kernels() const {
    long long count = 0;
    for (const SolidRegion& r : problem.solid().regions()) count += r.count;
    return count;
  }
};

TEST(OnlyRequired, ASolidAloneIsAppliedWithoutAllocations) {
  Linearised block(stretched_block(3, "0.1"));
  EXPECT_TRUE(block.problem.terms().empty());
  EXPECT_EQ(allocated([&] { block.apply_displacement(); }), 0);
  EXPECT_EQ(allocated([&] { block.apply(); }), 0);
}

TEST(OnlyRequired, PartsLeftOutLeaveNothingBehind) {
  Linearised all(shell({})), no_bars(shell({.bars = false})), no_cap(shell({.cap = false})),
      no_liquid(shell({.liquid = false}));
  EXPECT_EQ(all.problem.terms().size(), 1u);
  EXPECT_TRUE(no_bars.problem.terms().empty());
  EXPECT_EQ(all.problem.liquids().size(), 1u);
  EXPECT_TRUE(no_liquid.problem.liquids().empty());
  EXPECT_TRUE(no_liquid.system->liquid_columns().empty());
  EXPECT_EQ(no_liquid.system->layout().liquids, 0);
  EXPECT_EQ(all.system->layout().bodies, 6);
  EXPECT_EQ(no_cap.system->layout().bodies, 0);
  EXPECT_LT(no_liquid.system->bytes(), all.system->bytes());
}

TEST(OnlyRequired, ApplyAllocatesForTheLiquidOnlyWhereThereIsOne) {
  Linearised none(shell({.bars = false, .cap = false, .liquid = false})),
      liquid(shell({.bars = false, .cap = false}));
  const auto of = [](Linearised& l) { return allocated([&] { l.apply(); }); };
  EXPECT_EQ(of(none), 0);
  EXPECT_GT(of(liquid), 0);
  EXPECT_EQ(allocated([&] { none.apply_displacement(); }), 0);
}

TEST(OnlyRequired, RigidHexahedraAreNotInTheKernels) {
  Linearised rigid_cap(shell({})), soft_cap(shell({.cap = false}));
  const long long cap = static_cast<long long>(rigid_cap.problem.solid().rigid_hexes().size());
  ASSERT_GT(cap, 0);
  EXPECT_EQ(soft_cap.in_kernels(), soft_cap.problem.mesh().all_hexes);
  EXPECT_EQ(rigid_cap.in_kernels(), soft_cap.in_kernels() - cap);
  EXPECT_LT(rigid_cap.problem.dofs().free_unknowns(), soft_cap.problem.dofs().free_unknowns());
}

/// Allocations of a whole march; `asked`: the contact floor is asked for what the model says of it.
long long march_allocations(const Scene& scene, bool asked) {
  Trial run(scene);
  std::shared_ptr<Interactions> interactions;
  if (asked) interactions = Interactions::attach(run.problem, scene.mesh);
  const long long made = allocated([&] { run.iterative(); });
  EXPECT_TRUE(run.report.converged);
  EXPECT_TRUE(!asked || (interactions->contacts().empty() && interactions->sutures().empty() &&
                         interactions->bodies().empty()));
  return made;
}

TEST(OnlyRequired, ASceneWithoutContactsMarchesAsIfThereWereNoContactFloor) {
  const Scene scene = stretched_block(3, "0.1");
  march_allocations(scene, false);  // libraries start
  EXPECT_EQ(march_allocations(scene, true), march_allocations(scene, false));
}

/// Two blocks, one above the other at a distance, or one alone.
Scene blocks(bool both, double distance) {
  Scene scene{generate(BlockShape{.nx = 2, .ny = 2, .nz = 2, .region = "lower"}), {}};
  scene.mesh.surfaces = {{"lower_top", scene.mesh.surfaces.at("zmax")},
                         {"lower_bottom", scene.mesh.surfaces.at("zmin")}};
  scene.mesh.node_sets["base"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] < 1e-9; });
  scene.model.regions["lower"] = neo_hooke(.5);
  scene.model.fix.push_back({"base", {"x", "y", "z"}});
  scene.model.steps = {step("rest", 2)};
  if (!both) return scene;
  const double z = 1 + distance;
  Mesh upper = generate(BlockShape{
      .lower = {-.5, -.5, z}, .upper = {1.5, 1.5, z + 1}, .nx = 3, .ny = 3, .nz = 2, .region = "upper"});
  upper.surfaces = {{"upper_bottom", upper.surfaces.at("zmin")}};
  append(scene.mesh, upper);
  scene.mesh.node_sets["lid"] = nodes_where(scene.mesh, [&](const Point& p) { return p[2] > z + .9; });
  scene.model.regions["upper"] = neo_hooke(.5);
  scene.model.fix.push_back({"lid", {"x", "y", "z"}});
  scene.model.contacts.push_back({.name = "between", .slave = "lower_top", .master = "upper_bottom"});
  return scene;
}

TEST(OnlyRequired, WithoutContactsNothingIsSearchedAndWithOneOnlyWhatMoves) {
  const Scene alone = blocks(false, 0), both = blocks(true, .05);
  Trial without(alone), with(both);
  const auto none = Interactions::attach(without.problem, alone.mesh),
             one = Interactions::attach(with.problem, both.mesh);
  without.direct(), with.direct();
  ASSERT_TRUE(without.report.converged && with.report.converged);
  EXPECT_TRUE(none->contacts().empty());
  EXPECT_TRUE(without.problem.terms().empty());
  ASSERT_EQ(one->contacts().size(), 1u);
  EXPECT_EQ(one->contacts()[0].term->searches(), 1);  // nothing moves: what was found stays
}

}  // namespace
}  // namespace bulbus
