// The unloaded reference is the same on any number of ranks.
#include <gtest/gtest.h>

#include "app/eye/eye.hpp"
#include "core/problem/reference_model.hpp"
#include "core/solve/unloaded_reference.hpp"
#include "precond/make_preconditioner.hpp"
#include "tests/support/models.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

constexpr double pressure = .002;  // MPa

struct Drawn {
  Mesh mesh;
  Model model;
};

/// With a rigid lens in its zonules.
Drawn small_eye() {
  EyeSettings eye;
  eye.n = 4;
  Drawn d{generate(eye), {}};
  for (const std::string& name : d.mesh.region_names) d.model.regions[name] = neo_hooke(.3);
  d.model.regions["lens"] = rigid();
  d.model.bars["zonules"] = {};
  d.model.liquids["liquid"] = {.surface = "cavity"};
  d.model.symmetry = {"x"};
  d.model.fix.push_back({"nerve_end", {"x", "y", "z"}});
  return d;
}

Drawn octant() {
  Drawn d{generate(ShellShape{.inner = 10, .outer = 11, .n = 2, .layers = 1, .part = "octant"}), {}};
  d.model.regions["shell"] = neo_hooke(.1);
  d.model.liquids["liquid"] = {.surface = "inner"};
  d.model.symmetry = {"x", "y", "z"};
  return d;
}

/// Reference positions by the numbers of the finest mesh, on every rank.
std::vector<double> unloaded(const Drawn& drawn, int refinements, const Comm& comm) {
  ReferenceSpec reference;
  reference.loaded["liquid"] = std::to_string(pressure);
  reference.tolerance = 1e-8;
  auto levels = distribute_levels(drawn.mesh, refinements, comm, {});
  Profiler profiler;
  LinearSettings settings;
  settings.take_mesh(refinements);
  const auto report = find_unloaded(levels, reference_model(drawn.model, reference), reference,
                                    {settings, [&] { return make_solver(settings, profiler); }, profiler},
                                    [](const UnloadedIteration&) {});
  EXPECT_TRUE(report.found) << report.reason;
  EXPECT_GT(report.way, .01);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    std::vector<double> injected(levels[i - 1].mesh->X.size());
    levels[i].prolongation->inject(levels[i].mesh->X, injected);
    EXPECT_EQ(injected, levels[i - 1].mesh->X);
  }
  const LocalMesh& local = *levels.back().mesh;
  std::vector<double> X(3 * static_cast<std::size_t>(local.all_nodes));
  for (int n = 0; n < local.owned; ++n)
    for (int c = 0; c < 3; ++c) X[3 * local.input_node[n] + c] = local.X[3 * n + c];
  comm.sum(X);
  for (int n = local.owned; n < local.nodes(); ++n)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(local.X[3 * n + c], X[3 * local.input_node[n] + c]);
  return X;
}

void expect_the_same(const Drawn& drawn, int refinements) {
  const auto found = unloaded(drawn, refinements, Comm()),
             wanted = unloaded(drawn, refinements, Comm(MPI_COMM_SELF));
  ASSERT_EQ(found.size(), wanted.size());
  double most = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) most = worse(most, std::abs(found[i] - wanted[i]));
  EXPECT_LE(most, 1e-7);
}

TEST(Unloaded, DoesNotDependOnTheRanks) { expect_the_same(small_eye(), 0); }
TEST(Unloaded, DoesNotDependOnTheRanksOfARefinedMesh) { expect_the_same(octant(), 1); }

}  // namespace
}  // namespace bulbus
