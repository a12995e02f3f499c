#include "core/solve/reduced.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace bulbus::inline solve {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool all_free(const DofMap& dofs, std::span<const int> nodes) {
  return std::ranges::none_of(nodes, [&](int n) { return dofs.constrained(n); });
}

void nodal_dofs(std::span<const int> nodes, std::vector<int>& dofs) {
  dofs.clear();
  for (int n : nodes)
    for (int c = 0; c < 3; ++c) dofs.push_back(3 * n + c);
}

// T from reduced dofs to the contribution's nodal values, and those dofs.
Matrix transformation(const Problem& problem, const State& state, std::span<const int> nodes,
                      std::vector<int>& dofs) {
  const DofMap& map = problem.dofs();
  dofs.clear();
  for (int n : nodes) {
    const int b = map.body_of(n), first = b < 0 ? 3 * n : 3 * problem.mesh().nodes() + 6 * b;
    if (b < 0 || std::ranges::find(dofs, first) == dofs.end())
      for (int c = 0; c < (b < 0 ? 3 : 6); ++c) dofs.push_back(first + c);
  }
  Matrix T = Matrix::Zero(3 * nodes.size(), dofs.size());
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const int b = map.body_of(nodes[a]), first = b < 0 ? 3 * nodes[a] : 3 * problem.mesh().nodes() + 6 * b;
    const auto column = std::ranges::find(dofs, first) - dofs.begin();
    if (b < 0) {
      const Mat3<double> P = map.projector(nodes[a]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) T(3 * a + i, column + j) = P(i, j);
      continue;
    }
    const RigidBody& body = map.bodies()[b];
    const Vec3<double> r = body.arm(state.bodies[b], state.x, nodes[a]);
    // shift + spin × r
    const double spin[3][3] = {{0, r[2], -r[1]}, {-r[2], 0, r[0]}, {r[1], -r[0], 0}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (i == j && body.free()[j]) T(3 * a + i, column + j) = 1;
        if (body.free()[3 + j]) T(3 * a + i, column + 3 + j) = spin[i][j];
      }
  }
  return T;
}

}  // namespace

void for_each_condensed_matrix(const CoupledSystem& system, Matrices matrices,
                               const ReducedVisitor& visitor) {
  const Problem& problem = system.problem();
  std::vector<int> dofs;
  const auto reduce = [&](std::span<const int> nodes, std::span<const double> K) {
    if (all_free(problem.dofs(), nodes)) {
      nodal_dofs(nodes, dofs);
      visitor(dofs, K);
      return;
    }
    const Matrix T = transformation(problem, system.state(), nodes, dofs);
    const Eigen::Map<const Matrix> full(K.data(), T.rows(), T.rows());
    const Matrix reduced = T.transpose() * full * T;
    visitor(dofs, std::span(reduced.data(), reduced.size()));
  };
  switch (matrices) {
    case Matrices::mean:
      system.solid().visit_mean(reduce);
      break;
    case Matrices::reduced_augmentation:
      system.solid().visit_mean(reduce, .1);
      break;
    default:
      system.solid().visit(reduce, matrices == Matrices::augmented);
  }
  system.visit_surface(reduce);
}

void reduce_vector(const Problem& problem, const State& state, std::span<const int> nodes,
                   std::span<const double> v, std::vector<int>& dofs, std::vector<double>& values) {
  if (all_free(problem.dofs(), nodes)) {
    nodal_dofs(nodes, dofs);
    values.assign(v.begin(), v.end());
    return;
  }
  const Matrix T = transformation(problem, state, nodes, dofs);
  const Eigen::VectorXd reduced = T.transpose() * Eigen::Map<const Eigen::VectorXd>(v.data(), v.size());
  values.assign(reduced.data(), reduced.data() + reduced.size());
}

}  // namespace bulbus::inline solve
