#include "precond/schur/checkerboard_modes.hpp"

#include "precond/schur/checkerboard_matrix.hpp"
#include "tests/support/linearised.hpp"

namespace bulbus {
namespace {

Scene one_hexahedron() {
  Scene scene = stretched_block(1, ".1");
  scene.mesh = generate(BlockShape{.upper = {1, 2, 3}, .nx = 1, .ny = 1, .nz = 1});
  return scene;
}

TEST(CheckerboardModes, AreOrthogonal) {
  for (int refinements : {1, 2}) {
    const Linearised l(one_hexahedron(), refinements, 0);
    const CheckerboardModes modes(l.problem, refinements);
    ASSERT_EQ(modes.coarser(), 1);
    const int hexes = 1 << (3 * refinements), n = modes.count();
    EXPECT_EQ(n, refinements == 1 ? 4 : 10);
    for (int k = 0; k < n; ++k) {
      std::vector<double> c(n), p(hexes), back(n);
      c[k] = 1;
      modes.add_prolonged(c, 1, p);
      modes.restrict_pressures(p, back);
      for (int j = 0; j < n; ++j) EXPECT_EQ(back[j], j == k ? hexes : 0);
    }
  }
}

// Within a hexahedron that was split no node feels them: the spurious modes of Q1/P0.
TEST(CheckerboardModes, PushNoNodeWithinTheHexahedron) {
  for (int refinements : {1, 2}) {
    const Linearised l(one_hexahedron(), refinements, 0);
    const CheckerboardModes modes(l.problem, refinements);
    const auto& X = l.problem.mesh().X;
    for (int k = 0; k < modes.count(); ++k) {
      std::vector<double> c(modes.size()), p(l.problem.mesh().hexes.size()),
          force(l.system->layout().primal());
      c[k] = 1;
      modes.add_prolonged(c, 1, p);
      l.system->add_pressure_force(p, 1, force);
      double within = 0, all = 0;
      for (int n = 0; n < l.problem.mesh().owned; ++n) {
        const bool inner = X[3 * n] > .1 && X[3 * n] < .9 && X[3 * n + 1] > .1 && X[3 * n + 1] < 1.9 &&
                           X[3 * n + 2] > .1 && X[3 * n + 2] < 2.9;
        for (int i = 0; i < 3; ++i) ASSERT_TRUE(std::isfinite(force[3 * n + i]));
        for (int i = 0; i < 3; ++i)
          (inner ? within : all) = std::max(inner ? within : all, std::abs(force[3 * n + i]));
      }
      EXPECT_GT(all, 1e-3);
      EXPECT_LT(within, 1e-12);
    }
  }
}

TEST(CheckerboardModes, AreNoneOfRigidHexahedra) {
  const Linearised l(filled_shell("half"), 1, 0);
  const CheckerboardModes modes(l.problem, 1);
  ASSERT_FALSE(l.problem.solid().rigid_hexes().empty());
  for (int h : l.problem.solid().rigid_hexes()) EXPECT_EQ(modes.coarser_of(h), -1);
  std::vector<double> c(modes.size(), 1), p(l.problem.mesh().hexes.size());
  modes.add_prolonged(c, 1, p);
  for (int h : l.problem.solid().rigid_hexes()) EXPECT_EQ(p[h], 0);
}

TEST(CheckerboardJacobi, InvertsDiagonalBlocks) {
  const WithLines l(one_hexahedron(), 2, 0);
  const auto modes = std::make_shared<CheckerboardModes>(l.problem, 2);
  const CheckerboardMatrix matrix(*l.system, modes, *l.jacobi);
  const CheckerboardJacobi inverse(matrix);
  std::vector<double> c(modes->size(), 1), r(c.size()), back(c.size());
  matrix.apply(c, r);
  inverse.apply(r, back);
  for (double v : back) EXPECT_NEAR(v, 1, 1e-4);
}

}  // namespace
}  // namespace bulbus
