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

Model model_of(const Mesh& mesh) {
  Model m;
  for (const std::string& name : mesh.region_names) m.regions[name] = neo_hooke(.3);
  m.regions["lens"] = rigid();
  m.bars["zonules"] = {};
  m.liquids["vitreous"] = {.surface = "wet"};
  m.symmetry = {"x"};
  m.fix.push_back({"nerve_end", {"x", "y", "z"}});
  return m;
}

/// Reference places by the numbers of the finest mesh, on every rank.
std::vector<double> unloaded(const Mesh& mesh, int refinements, const Comm& comm) {
  ReferenceSpec reference;
  reference.loaded["vitreous"] = std::to_string(pressure);
  reference.tolerance = 1e-8;
  auto levels = distribute_levels(mesh, refinements, comm, {});
  Profiler profiler;
  LinearSettings settings;
  settings.take_mesh(refinements);
  const auto report = find_unloaded(levels, reference_model(model_of(mesh), reference), reference,
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

void expect_the_same(int refinements) {
  EyeSettings eye;
  eye.n = 4;
  const Mesh mesh = generate(eye);
  const auto found = unloaded(mesh, refinements, Comm()),
             wanted = unloaded(mesh, refinements, Comm(MPI_COMM_SELF));
  ASSERT_EQ(found.size(), wanted.size());
  double most = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) most = worse(most, std::abs(found[i] - wanted[i]));
  EXPECT_LE(most, 1e-7);
}

TEST(Unloaded, DoesNotDependOnTheRanks) { expect_the_same(0); }
TEST(Unloaded, DoesNotDependOnTheRanksOfARefinedMesh) { expect_the_same(1); }

}  // namespace
}  // namespace bulbus
