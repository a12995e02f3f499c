#include "precond/coarse/rigid_modes.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace bulbus::inline precond {
namespace {

using Plain = Eigen::Matrix<double, 3, 6>;
using Square = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

// Middles and sizes of all groups.
std::vector<RigidFrame> frames_of(const CoupledSystem& system, const Aggregates& groups) {
  const LocalMesh& mesh = system.problem().mesh();
  const auto& x = system.state().x;
  std::vector<double> sums(4 * groups.total), radius(groups.total);
  for (int n = 0; n < mesh.owned; ++n)
    if (const int a = groups.of[n]; a >= 0) {
      for (int c = 0; c < 3; ++c) sums[4 * a + c] += x[3 * n + c];
      sums[4 * a + 3] += 1;
    }
  mesh.comm.sum(sums);
  std::vector<RigidFrame> places(groups.total);
  for (int a = groups.bodies; a < groups.total; ++a)
    for (int c = 0; c < 3; ++c) places[a].center[c] = sums[4 * a + c] / sums[4 * a + 3];
  for (int n = 0; n < mesh.owned; ++n)
    if (const int a = groups.of[n]; a >= 0)
      for (int c = 0; c < 3; ++c)
        radius[a] = std::max(radius[a], std::abs(x[3 * n + c] - places[a].center[c]));
  mesh.comm.max(radius);
  for (int a = 0; a < groups.total; ++a) places[a].inverse_radius = 1 / std::max(radius[a], 1e-300);
  return places;
}

// Three translations and three rotations about the middle, of about the same size.
Plain plain_modes(const CoupledSystem& system, int node, const RigidFrame& place) {
  const auto& x = system.state().x;
  Vec3<double> r;
  for (int c = 0; c < 3; ++c) r[c] = (x[3 * node + c] - place.center[c]) * place.inverse_radius;
  Plain m;
  m << 1, 0, 0, 0, r[2], -r[1], 0, 1, 0, -r[2], 0, r[0], 0, 0, 1, r[1], -r[0], 0;
  const DofMap& dofs = system.problem().dofs();
  if (!dofs.constrained(node)) return m;
  const Mat3<double> P = dofs.projector(node);
  const Plain full = m;
  for (int i = 0; i < 3; ++i)
    m.row(i) = P(i, 0) * full.row(0) + P(i, 1) * full.row(1) + P(i, 2) * full.row(2);
  return m;
}

std::vector<Square> grams(const CoupledSystem& system, const Aggregates& groups,
                          const std::vector<RigidFrame>& places) {
  std::vector<Square> gram(groups.total, Square::Zero());
  for (int n = 0; n < system.problem().mesh().owned; ++n)
    if (const int a = groups.of[n]; a >= 0) {
      const Plain m = plain_modes(system, n, places[a]);
      gram[a].noalias() += m.transpose() * m;
    }
  system.problem().comm().sum(std::span(gram.data()->data(), 36 * gram.size()));
  return gram;
}

}  // namespace

BlockMatrix::Block orthonormal_basis(const BlockMatrix::Block& of) {
  const Eigen::Map<const Square> gram(of.data());
  const double least = 1e-6 * gram.diagonal().maxCoeff();
  BlockMatrix::Block columns{};
  Eigen::Map<Square> b(columns.data());
  for (int k = 0; k < 6; ++k) {
    Eigen::Matrix<double, 6, 1> v = Square::Identity().col(k);
    for (int again = 0; again < 2; ++again) v -= (b * (b.transpose() * (gram * v))).eval();
    if (const double value = v.dot(gram * v); value > least) b.col(k) = v / std::sqrt(value);
  }
  return columns;
}

RigidModes rigid_modes(const CoupledSystem& system, const Aggregates& groups) {
  RigidModes modes{std::vector<NodeModes>(groups.of.size()), frames_of(system, groups), {}};
  const auto gram = grams(system, groups, modes.frames);
  std::vector<Square> bases(groups.total);
  for (int a = 0; a < groups.total; ++a) {
    BlockMatrix::Block of;
    Eigen::Map<Square>(of.data()) = gram[a];
    const auto basis = orthonormal_basis(of);
    bases[a] = Eigen::Map<const Square>(basis.data());
    Eigen::Map<Square>(modes.frames[a].coordinates.data()) = bases[a].transpose() * gram[a];
  }
  for (std::size_t n = 0; n < groups.of.size(); ++n)
    if (const int a = groups.of[n]; a >= 0) {
      const Plain m = plain_modes(system, static_cast<int>(n), modes.frames[a]) * bases[a];
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 6; ++k) modes.of[n][i][k] = static_cast<float>(m(i, k));
    }
  for (int a = groups.first; a < groups.first + groups.mine; ++a)
    for (int k = 0; k < 6; ++k)
      if (bases[a].col(k).isZero(0)) modes.missing.push_back(6 * a + k);
  return modes;
}

}  // namespace bulbus::inline precond
