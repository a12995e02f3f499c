#include "precond/operators/single_block.hpp"

#include <gtest/gtest.h>

#include "precond/operators/displacement.hpp"
#include "precond/smoothers/smoother.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

// Contribution by contribution, in double precision: bars, liquids, nodes of rigid bodies and constrained
// directions as they are.
std::vector<double> by_matrices(const Linearised& l, const std::vector<double>& x) {
  const Layout& layout = l.system->layout();
  const DofMap& dofs = l.problem.dofs();
  std::vector<double> y(x.size());
  for_each_condensed_matrix(*l.system, Matrices::mean,
                            [&](std::span<const int> d, std::span<const double> K) {
                              for (std::size_t i = 0; i < d.size(); ++i)
                                for (std::size_t j = 0; j < d.size(); ++j)
                                  y[d[i]] += K[i * d.size() + j] * x[d[j]];
                            });
  l.system->add_body_geometry(std::span(x).subspan(layout.nodal), std::span(y).subspan(layout.nodal));
  for (int n = 0; n < l.problem.mesh().owned; ++n) {
    const Mat3<double> P = dofs.projector(n);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        y[3 * n + i] += l.system->constrained_diagonal() * ((i == j) - P(i, j)) * x[3 * n + j];
  }
  return y;
}

TEST(SingleBlock, IsTheSumOfContributions) {
  for (const Scene& scene : {thin_plate(), filled_shell("half"), small_eye(8)}) {
    const Linearised l(scene, 0, .002);
    const SingleBlock A(l.system);
    const auto x = noise_primal(l.problem, 1);
    std::vector<double> y(x.size(), std::nan(""));
    for (int again = 0; again < 2; ++again) {  // it leaves nothing behind
      A.apply(x, y);
      EXPECT_LT(relative_difference(y, by_matrices(l, x)), 5e-6);
    }
  }
}

// A translation far larger than the strain on top of it, away from what is prescribed.
TEST(SingleBlock, DoesNotDrownStrainInTranslations) {
  const Linearised l(cylinder(), 0, 0);
  const SingleBlock A(l.system);
  const auto x = noise_primal(l.problem, 1);
  std::vector<double> moved(x), y(x.size());
  for (double& v : moved) v += 1e4;
  A.apply(moved, y);
  auto expected = by_matrices(l, x);
  for (const Hex& h : l.problem.mesh().hexes)
    if (std::ranges::any_of(h, [&](int n) { return l.problem.dofs().constrained(n); }))
      for (int n : h)
        for (int c = 0; c < 3; ++c) y[3 * n + c] = expected[3 * n + c] = 0;
  EXPECT_GT(largest(expected), 0);
  EXPECT_LT(relative_difference(y, expected), 1e-5);
}

// Both precisions on parallelepipeds at rest, where means are exact: r and x of the smoother before, x of the
// one after.
TEST(Smoother, IsTheSameInBothPrecisions) {
  const WithLines l(thin_plate(), 0, 0);
  const SmootherSettings settings{5, .1};
  auto b = noise_primal(l.problem, 1), e = noise_primal(l.problem, 2);
  for (auto* v : {&b, &e})
    l.problem.dofs().project(
        *v);  // constrained directions are solved for at once in one, smoothed in the other
  std::vector<std::vector<double>> found;
  for (Precision precision : {Precision::full, Precision::single}) {
    const auto S = make_smoother(l.system, l.jacobi, settings, precision);
    std::vector<double> x(b.size(), std::nan("")), r(x), improved(x);
    S->before(b, x, r);
    found.push_back(x), found.push_back(r);
    S->after(e, x);
    S->improve(b, e, improved);
    found.push_back(x), found.push_back(improved);
  }
  for (int i = 0; i < 4; ++i) EXPECT_LT(relative_difference(found[4 + i], found[i]), 2e-5) << i;
}

}  // namespace
}  // namespace bulbus
