// What a problem is made of does not depend on who holds which hexahedron, and is refused by all or by none.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/problem/problem.hpp"
#include "precond/coarse/distributed_blocks.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/two_regions.hpp"

namespace bulbus {
namespace {

double force_along_x(const Scene& scene) {
  Problem p(scene.mesh, scene.model, Comm());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  const Residual r = p.residual(s);
  double sum = 0;
  for (int n = 0; n < p.mesh().owned; ++n) sum -= r.force[3 * n];
  return p.comm().sum(sum);
}

// A face belongs to the rank of the first hexahedron that has it; the region that is named may be on another.
TEST(Loads, PushIntoTheirRegionWhoeverHoldsIt) {
  Scene scene = two_regions();
  for (const auto& [region, force] : {std::pair{"left", -.1}, {"right", .1}}) {
    scene.model.steps[0].loads = {on_side(region, "0.1")};
    EXPECT_NEAR(force_along_x(scene), force, 1e-13) << region;
  }
}

// A rank that alone sees what is wrong must not leave the others waiting.
TEST(RigidRegions, ThatShareNodesAreRefusedByAllRanks) {
  Scene scene = row_of_four({0, 1, 2, 2}, {"a", "b", "soft"});
  for (const char* name : {"a", "b"}) scene.model.regions[name] = {.rigid = true};
  EXPECT_THROW(Problem(scene.mesh, scene.model, Comm()), InputError);
}

DistributedBlocks ring(const Comm& comm) {
  const int mine = 3;
  const long long first = comm.offset(static_cast<long long>(mine)),
                  total = comm.sum(static_cast<long long>(mine));
  return assemble_blocks(comm, mine, [&](const BlockVisitor& visit) {
    for (long long i = first; i < first + mine; ++i)
      for (const long long j : {(i + total - 1) % total, i, (i + 1) % total}) {
        BlockMatrix::Block block;
        for (int e = 0; e < 36; ++e)
          block[e] =
              noise(4, static_cast<int>(36 * std::abs(i - j) + e)) / 8 + (i == j && e % 7 == 0 ? 4 : 0);
        visit(i, j, block);
      }
  });
}

void expect_residual(const DistributedBlocks& d, std::vector<double> x, std::span<const double> b,
                     std::span<const double> rest) {
  d.rows.halo.update_ghosts(x, 6);
  std::vector<double> Ax(rest.size());
  d.A.apply(x, Ax);
  for (std::size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(rest[i], b[i] - Ax[i], 1e-12) << i;
}

// Of sweeps that end at the ranks' boundaries, put together from halves of the matrix.
TEST(BlockMatrix, ResidualsOfSweepsAreThoseOfAllColumns) {
  const DistributedBlocks d = ring(Comm());
  const std::size_t mine = 6 * d.rows.mine, all = 6 * d.rows.size();
  std::vector<double> b(mine), x(all), step(all), rest(mine);
  for (std::size_t i = 0; i < mine; ++i) b[i] = noise(5, static_cast<int>(6 * d.rows.first + i));
  d.A.sweep_forwards(b, x, rest);
  d.rows.halo.update_ghosts(std::span(x), 6);
  d.A.subtract_upper(x, rest);
  expect_residual(d, x, b, rest);
  d.A.sweep_backwards(b, x, step, rest);
  d.rows.halo.update_ghosts(std::span(step), 6);
  d.A.subtract_lower(step, rest);
  expect_residual(d, x, b, rest);
}

}  // namespace
}  // namespace bulbus
