// Probes and fields of contacts however many ranks: of a prescribed state, on every rank by itself and
// together.
#include <gtest/gtest.h>

#include "app/records/contact_fields.hpp"
#include "app/records/result_fields.hpp"
#include "contact/interaction_figures.hpp"
#include "contact/interaction_probes.hpp"
#include "tests/support/two_regions.hpp"

namespace bulbus {
namespace {

ProbeSpec probe(const std::string& kind, const std::string& component = "magnitude",
                const std::string& set = "") {
  ProbeSpec p;
  p.name = kind + " " + component + " " + set;
  p.kind = kind, p.component = component, p.set = set;
  p.contact = "press", p.body = "plate";
  return p;
}

/// A bar along x, a tilted plate against its end: some ranks have no slave nodes.
Scene bar() {
  Scene s{generate(BlockShape{.upper = {6, 1, 1}, .nx = 12, .ny = 3, .nz = 3}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.symmetry = {"y"};
  s.model.fix.push_back({"xmin", {"x", "y", "z"}});
  s.model.rigid_bodies["plate"].plane = PlaneShape{.point = {6, 0, .5}, .normal = {-1, 0, .1}};
  s.model.contacts.push_back({.name = "press", .slave = "xmax", .master = "plate", .start = "resolve"});
  s.model.steps = {step("one")};
  for (const char* kind : {"contact_area", "contact_pressure", "mean_contact_pressure", "contact_fraction",
                           "penetration", "gap", "closed_fraction"})
    s.model.probes.push_back(probe(kind));
  s.model.probes.push_back(probe("sealed_fraction", "magnitude", "ymax"));
  for (const char* c : {"x", "z", "radial"}) s.model.probes.push_back(probe("body_force", c));
  s.model.probes.push_back(probe("body_moment", "y"));
  s.model.probes.push_back(probe("reaction", "x", "xmin"));
  s.model.probes.push_back(probe("mises", "magnitude", "xmin"));
  return s;
}

struct Trial {
  Problem problem;
  std::shared_ptr<Interactions> interactions;
  State state;
  Snapshot snapshot;
  Trial(const Scene& scene, const Comm& comm)
      : problem(scene.mesh, scene.model, comm),
        interactions(Interactions::attach(problem, scene.mesh)),
        state(problem.initial_state()),
        snapshot(problem, state) {
    for (std::size_t n = 0; n < state.x.size(); n += 3) state.x[n + 1] *= 1 + .02 * state.x[n];
  }
};

TEST(ContactFigures, DoNotDependOnTheRanks) {
  const Scene scene = bar();
  Trial alone(scene, Comm(MPI_COMM_SELF)), together(scene, Comm());
  const ProbeSet probes(alone.problem, interaction_probes(alone.interactions));
  const auto expected = probes.values(alone.snapshot),
             found = ProbeSet(together.problem, interaction_probes(together.interactions))
                         .values(together.snapshot);
  ASSERT_EQ(found.size(), scene.model.probes.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-10 * (1 + std::abs(expected[i]))) << probes.name(i);
    EXPECT_NE(expected[i], 0) << probes.name(i);
  }
  const auto one = standing(alone.interactions->contacts()[0], alone.snapshot),
             all = standing(together.interactions->contacts()[0], together.snapshot);
  EXPECT_EQ(all.touching, one.touching);
  EXPECT_NEAR(all.on_master[0].force[0], one.on_master[0].force[0], 1e-10);
}

bool same(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance || (std::isnan(a) && std::isnan(b));
}

/// Ghost nodes too.
TEST(ContactFields, DoNotDependOnTheRanks) {
  const Scene scene = bar();
  Trial alone(scene, Comm(MPI_COMM_SELF)), together(scene, Comm());
  const auto expected = contact_fields(*alone.interactions, alone.snapshot),
             found = contact_fields(*together.interactions, together.snapshot);
  ASSERT_EQ(found.size(), 3u);
  std::vector<int> local(alone.problem.mesh().nodes());
  for (std::size_t n = 0; n < local.size(); ++n)
    local[alone.problem.mesh().input_node[n]] = static_cast<int>(n);
  for (std::size_t f = 0; f < 3; ++f)
    for (int n = 0; n < together.problem.mesh().nodes(); ++n)
      EXPECT_TRUE(
          same(found[f].values[n], expected[f].values[local[together.problem.mesh().input_node[n]]], 1e-12))
          << found[f].name << ' ' << n;
}

// On two and three ranks some have none.
TEST(ResultFields, AreMadeWhereARankHasNoDeformableHexahedron) {
  Scene scene = row_of_four({1, 1, 0, 0}, {"hard", "soft"});
  scene.model.regions["hard"] = {}, scene.model.regions["hard"].rigid = true;
  Trial run(scene, Comm());
  const auto points = reference_points(run.problem.mesh());
  const Piece piece = piece_of(run.snapshot, *run.interactions, {"displacement", "pressure"}, points);
  ASSERT_EQ(piece.cell_fields.size(), 2u);
  EXPECT_EQ(piece.cell_fields[1].values.size(), run.problem.mesh().hexes.size());
}

}  // namespace
}  // namespace bulbus
