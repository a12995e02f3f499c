// Corrections for oscillating pressures are the same whichever ranks their hexahedra are on.
#include <gtest/gtest.h>

#include "precond/schur/checkerboard_matrix.hpp"
#include "precond/schur/oscillation_filter.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

// Of a hexahedron of the whole mesh: the same on all ranks.
double noise(int hex, int k) { return std::sin(12.9898 * hex + 78.233 * k); }

std::vector<double> noise(const CheckerboardModes& modes) {
  std::vector<double> c(modes.size());
  for (int i = 0; i < modes.size(); ++i) c[i] = noise(modes.labels()[i / modes.count()], i % modes.count());
  return c;
}

void expect_product(const Scene& scene, int refinements) {
  const WithLines l(scene, refinements, 0);
  const auto K = std::make_shared<LinePressureStiffness>(l.system, l.jacobi);
  const auto modes = std::make_shared<CheckerboardModes>(l.problem, refinements);
  const CheckerboardMatrix matrix(*l.system, modes, *l.jacobi);
  const CheckerboardProduct product(modes, K);
  const auto c = noise(*modes);
  std::vector<double> found(c.size(), std::nan("")), expected(c.size());
  matrix.apply(c, found);
  product.apply(c, expected);
  double size = 0;
  for (double v : expected) size = std::max(size, std::abs(v));
  EXPECT_GT(Comm().max(size), 0);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-5 * size) << i;
}

// What R leaves of pressures that a hexahedron's place in the whole mesh gives, by that place.
std::vector<double> rough(const Scene& scene, const Comm& comm,
                          const std::function<double(int region, int hex)>& pressure) {
  const Problem problem(scene.mesh, scene.model, comm);
  const LocalMesh& mesh = problem.mesh();
  std::vector<double> p(mesh.hexes.size()), all(mesh.all_hexes);
  for (std::size_t region = 0; region < mesh.regions.size(); ++region)
    for (int k = 0; k < mesh.regions[region].count; ++k) {
      const int h = mesh.regions[region].first + k;
      p[h] = pressure(static_cast<int>(region), mesh.input_hex[h]);
    }
  for (int h : problem.solid().rigid_hexes()) p[h] = 0;
  OscillationFilter(problem).apply(p);
  for (std::size_t h = 0; h < p.size(); ++h) all[mesh.input_hex[h]] = p[h];
  comm.sum(all);
  return all;
}

TEST(OscillationFilter, TakesWhatIsTheSameInATissue) {
  for (double v :
       not_empty(rough(small_eye(8), Comm(), [](int region, int) { return std::pow(100., region); })))
    EXPECT_NEAR(v, 0, 1e-3);
}

TEST(OscillationFilter, IsTheSameOnAnyNumberOfRanks) {
  for (const Scene& scene : {filled_shell("half"), small_eye(8)}) {
    const auto pressure = [](int, int hex) { return noise(hex, 1); };
    const auto alone = rough(scene, Comm(MPI_COMM_SELF), pressure), together = rough(scene, Comm(), pressure);
    ASSERT_EQ(alone.size(), together.size());
    for (std::size_t h = 0; h < alone.size(); ++h) EXPECT_NEAR(together[h], alone[h], 1e-14) << h;
  }
}

TEST(OscillationFilter, KeepsAChessboard) {
  const Scene block = stretched_block(4, ".1");
  const auto sign = [](int, int hex) { return (hex + hex / 4 + hex / 16) % 2 ? -1. : 1.; };  // x fastest
  const auto kept = rough(block, Comm(), sign);
  for (int k = 1; k < 3; ++k)
    for (int j = 1; j < 3; ++j)
      for (int i = 1; i < 3; ++i) EXPECT_EQ(std::abs(kept[i + 4 * j + 16 * k]), 1);
}

TEST(CarriedByLines, AFilmIsOnAnyNumberOfRanks) {
  const WithLines l(glued_slab(50, false), 0, 0);
  const auto carried = carried_by_lines(*l.system, *l.jacobi);
  EXPECT_EQ(std::ranges::count(carried, 1), std::ssize(carried));
}

TEST(CheckerboardMatrix, IsTheProductOfABlock) {
  for (int refinements : {1, 2}) expect_product(stretched_block(4, ".1"), refinements);
}

TEST(CheckerboardMatrix, IsTheProductOfAShellWithARigidCap) {
  for (int refinements : {1, 2}) expect_product(filled_shell("half"), refinements);
}

TEST(CheckerboardMatrix, IsTheProductOfTheHalfEye) { expect_product(small_eye(8), 1); }

TEST(CheckerboardMatrix, DropsWhatHardlyCouples) {
  const WithLines l(small_eye(8), 1, 0);
  const auto modes = std::make_shared<CheckerboardModes>(l.problem, 1);
  CheckerboardMatrix matrix(*l.system, modes, *l.jacobi);
  const auto c = noise(*modes);
  std::vector<double> whole(c.size()), kept(c.size()), back(c.size());
  matrix.apply(c, whole);
  const std::size_t bytes = matrix.bytes();
  matrix.drop(3e-4);
  EXPECT_LT(matrix.bytes(), bytes);
  matrix.apply(c, kept);
  double size = 0, error = 0;
  for (std::size_t i = 0; i < c.size(); ++i)
    size += whole[i] * whole[i], error += std::pow(kept[i] - whole[i], 2);
  EXPECT_LT(Comm().sum(error), 1e-6 * Comm().sum(size));
  matrix.drop(10);  // all but the diagonal's
  matrix.apply(c, kept);
  CheckerboardJacobi(matrix).apply(kept, back);
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(back[i], c[i], 1e-3);
}

}  // namespace
}  // namespace bulbus
