#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/eye/eye.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/prolongation.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

LocalMesh alone(const Mesh& mesh) {
  return distribute(mesh, std::vector<int>(mesh.hexes.size(), 0), Comm(MPI_COMM_SELF));
}

// A field on the nodes that tells them apart.
std::vector<double> field(const LocalMesh& mesh, int seed) {
  std::vector<double> v;
  for (int i = 0; i < 3 * mesh.nodes(); ++i) v.push_back(std::sin(seed + 12.9898 * i));
  return v;
}

// A mesh, its refinement and what lies between them, on one rank.
struct Two {
  Mesh base;
  RefinedMesh refinement;
  LocalMesh coarse, fine;
  Prolongation prolongation;
  explicit Two(Mesh mesh)
      : base(std::move(mesh)),
        refinement(refine(base)),
        coarse(alone(base)),
        fine(alone(refinement.mesh)),
        prolongation(refinement, coarse, fine) {}
  Interpolation at() const {
    return prolongation.at(coarse.X, fine.X, std::vector<double>(coarse.hexes.size(), 1));
  }
};

Mesh small_eye() {
  EyeSettings s;
  s.n = 4;
  return generate(s);
}

TEST(Prolongation, ReproducesLinearFieldsOnCurvedMeshes) {
  for (const Mesh& mesh : {generate(BlockShape{.upper = {1, 2, 3}, .nx = 2, .ny = 3, .nz = 2}),
                           generate(BallShape{}), small_eye()}) {
    const Two two(mesh);
    const auto linear = [](const LocalMesh& m) {
      std::vector<double> v;
      for (int n = 0; n < m.nodes(); ++n) {
        const double* X = &m.X[3 * n];
        v.insert(v.end(), {1 + 2 * X[0] - X[1], X[2] + .5 * X[0], 3 - X[1] + X[2]});
      }
      return v;
    };
    std::vector<double> got(3 * two.fine.nodes());
    two.at().apply(linear(two.coarse), got);
    const auto wanted = linear(two.fine);
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 1e-4);
  }
}

TEST(Prolongation, OnFlatMeshesIsTheMeanOfTheParents) {
  const Two two(generate(BlockShape{.nx = 2, .ny = 2, .nz = 2}));
  const Interpolation I = two.at();
  for (int n = 0; n < two.fine.nodes(); ++n) {
    auto wanted = two.refinement.parents_of(two.fine.input_node[n]);
    const auto stencil = I.stencil(n);
    std::vector<int> got;
    for (std::size_t k = 0; k < stencil.nodes.size(); ++k) {
      got.push_back(two.coarse.input_node[stencil.nodes[k]]);
      EXPECT_NEAR(stencil.weights[k], 1.0 / wanted.size(), 1e-6);
    }
    std::sort(got.begin(), got.end());
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(got, wanted);
  }
}

TEST(Prolongation, HasItsTransposeAndInjectionIsItsInverse) {
  const Two two(small_eye());
  const Interpolation I = two.at();
  const auto x = field(two.coarse, 1), y = field(two.fine, 2);
  std::vector<double> Ix(y.size()), Iy(x.size()), back(x.size());
  I.apply(x, Ix);
  I.apply_transposed(y, Iy);
  two.prolongation.inject(Ix, back);
  EXPECT_NEAR(inner(y, Ix), inner(Iy, x), 1e-10 * std::abs(inner(y, Ix)) + 1e-10);
  EXPECT_EQ(back, x);
}

}  // namespace
}  // namespace bulbus
