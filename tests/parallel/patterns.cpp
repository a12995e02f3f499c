// The matrix of the weak pressure patterns is the product of its factors, whichever ranks its hexahedra are on.
#include <gtest/gtest.h>

#include "precond/pattern_matrix.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

// Of a hexahedron of the whole mesh: the same on all ranks.
double noise(int hex, int k) { return std::sin(12.9898 * hex + 78.233 * k); }

void expect_product(const Scene& scene, int refinements) {
  Problem problem(refined(scene.mesh, refinements), scene.model, Comm());
  const State state = problem.initial_state();
  LinearSettings settings;
  CoupledSystem system(problem, settings);
  system.linearize(state, problem.residual(state));
  const Lines lines = find_lines(problem);
  const LineJacobi jacobi(system, lines);
  const LinePressureStiffness K(system, jacobi);
  const Patterns patterns(problem, refinements);
  const PatternMatrix matrix(problem, patterns, K, jacobi);
  const PatternProduct product(patterns, K);
  std::vector<double> c(patterns.size()), found(c.size(), std::nan("")), expected(c);
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = noise(patterns.labels()[i / patterns.count()], static_cast<int>(i) % patterns.count());
  matrix.apply(c, found);
  product.apply(c, expected);
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    size = std::max(size, std::abs(expected[i]));
    difference = std::max(difference, std::abs(found[i] - expected[i]));
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(difference, 1e-5 * size);
}

TEST(PatternMatrix, IsTheProductOfABlock) {
  for (int refinements : {1, 2}) expect_product(stretched_block(4, ".1"), refinements);
}

TEST(PatternMatrix, IsTheProductOfAShellWithARigidCap) {
  for (int refinements : {1, 2}) expect_product(filled_shell("half"), refinements);
}

TEST(PatternMatrix, IsTheProductOfTheHalfEye) { expect_product(small_eye(8), 1); }

}  // namespace
}  // namespace bulbus
