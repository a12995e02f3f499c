#include "core/problem/coarse_positions.hpp"

#include <gtest/gtest.h>

#include "tests/support/models.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

TEST(CoarsePositions, AreRelaxedAroundHexahedraThatAreInverted) {
  const Scene scene = stretched_block(4, "0");
  const Problem problem(scene.mesh, scene.model, Comm(MPI_COMM_SELF));
  const LocalMesh& mesh = problem.mesh();
  int middle = 0;
  const auto distance = [&](int n) {
    return std::hypot(mesh.X[3 * n] - .5, mesh.X[3 * n + 1] - .5, mesh.X[3 * n + 2] - .5);
  };
  for (int n = 0; n < mesh.nodes(); ++n)
    if (distance(n) < distance(middle)) middle = n;
  std::vector<double> x = mesh.X;
  x[3 * middle + 2] += .5;  // through the next layer of hexahedra, which are .25 mm high
  ASSERT_LT(problem.solid().least_jacobian(x), 0);
  relax_inverted(problem, x);
  EXPECT_GT(problem.solid().least_jacobian(x), .3);
  EXPECT_GT(x[3 * middle + 2], mesh.X[3 * middle + 2]);
  for (int n = 0; n < mesh.nodes(); ++n)
    if (distance(n) > .6)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(x[3 * n + c], mesh.X[3 * n + c], .1);
}

TEST(CoarsePositions, StayWhereNothingIsInverted) {
  const Scene scene = stretched_block(3, "0");
  const Problem problem(scene.mesh, scene.model, Comm(MPI_COMM_SELF));
  std::vector<double> x = deformed(problem.mesh().X, 3, .05);
  const auto before = x;
  relax_inverted(problem, x);
  EXPECT_EQ(x, before);
}

}  // namespace
}  // namespace bulbus
