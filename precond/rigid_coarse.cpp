#include "precond/rigid_coarse.hpp"

#include <algorithm>

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"
#include "precond/aggregates.hpp"

namespace bulbus {
namespace {

// Aggregate of every local node in the numbering of all ranks, ghosts included; returns the number of aggregates too.
std::vector<int> globally(const CoupledSystem& system, const std::vector<int>& owned, int& total) {
  const LocalMesh& mesh = system.problem().mesh();
  const long long mine = owned.empty() ? 0 : *std::ranges::max_element(owned) + 1;
  const long long first = mesh.comm.offset(mine);
  total = static_cast<int>(mesh.comm.sum(mine));
  std::vector<double> all(mesh.nodes(), -1);
  for (std::size_t n = 0; n < owned.size(); ++n) all[n] = owned[n] < 0 ? -1 : static_cast<double>(first + owned[n]);
  mesh.halo.update(all, 1);
  return {all.begin(), all.end()};
}

}  // namespace

RigidCoarse::RigidCoarse(const CoupledSystem& system, const std::array<DistributedCsr, 3>& scalar, int aggregates) : system_(system) {
  int total = 0;
  of_ = globally(system, aggregate(system, scalar, aggregates), total);
  aggregates_.resize(total);
  find_bases();
  factor_.compute(coarse_matrix());
}

RigidCoarse::Modes RigidCoarse::plain_modes(int node) const {
  const Aggregate& a = aggregates_[of_[node]];
  const auto& x = system_.state().x;
  Vec3<double> r;
  for (int c = 0; c < 3; ++c) r[c] = (x[3 * node + c] - a.center[c]) * a.inverse_radius;
  Modes m;
  m << 1, 0, 0, 0, r[2], -r[1], 0, 1, 0, -r[2], 0, r[0], 0, 0, 1, r[1], -r[0], 0;
  if (!system_.problem().dofs().held(node)) return m;
  const Mat3<double> P = system_.problem().dofs().projector(node);
  const Modes full = m;
  for (int i = 0; i < 3; ++i) m.row(i) = P(i, 0) * full.row(0) + P(i, 1) * full.row(1) + P(i, 2) * full.row(2);
  return m;
}

RigidCoarse::Modes RigidCoarse::modes(int node) const { return plain_modes(node) * aggregates_[of_[node]].basis; }

void RigidCoarse::find_bases() {
  const LocalMesh& mesh = system_.problem().mesh();
  const auto& x = system_.state().x;
  std::vector<double> sums(5 * aggregates_.size());
  for (int n = 0; n < mesh.owned; ++n)
    if (of_[n] >= 0) {
      for (int c = 0; c < 3; ++c) sums[5 * of_[n] + c] += x[3 * n + c];
      sums[5 * of_[n] + 3] += 1;
    }
  mesh.comm.sum(sums);
  for (std::size_t a = 0; a < aggregates_.size(); ++a)
    for (int c = 0; c < 3; ++c) aggregates_[a].center[c] = sums[5 * a + c] / sums[5 * a + 3];
  for (int n = 0; n < mesh.owned; ++n)
    if (of_[n] >= 0)
      for (int c = 0; c < 3; ++c) sums[5 * of_[n] + 4] = std::max(sums[5 * of_[n] + 4], std::abs(x[3 * n + c] - aggregates_[of_[n]].center[c]));
  mesh.comm.max(sums);
  std::vector<double> gram(36 * aggregates_.size());
  for (std::size_t a = 0; a < aggregates_.size(); ++a) aggregates_[a].inverse_radius = 1 / std::max(sums[5 * a + 4], 1e-300);
  for (int n = 0; n < mesh.owned; ++n)
    if (of_[n] >= 0) {
      const Modes m = plain_modes(n);
      Eigen::Map<Eigen::Matrix<double, 6, 6>>(&gram[36 * of_[n]]) += m.transpose() * m;
    }
  mesh.comm.sum(gram);
  for (std::size_t a = 0; a < aggregates_.size(); ++a) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(Eigen::Map<Eigen::Matrix<double, 6, 6>>(&gram[36 * a]));
    for (int k = 0; k < 6; ++k) {
      const double value = eigen.eigenvalues()[k];
      const bool kept = value > 1e-6 * eigen.eigenvalues()[5];
      aggregates_[a].basis.col(k) = kept ? Eigen::Matrix<double, 6, 1>(eigen.eigenvectors().col(k) / std::sqrt(value)) : Eigen::Matrix<double, 6, 1>::Zero();
    }
  }
}

Eigen::MatrixXd RigidCoarse::coarse_matrix() const {
  const Problem& problem = system_.problem();
  const int nodal = 3 * problem.mesh().nodes(), six = 6 * static_cast<int>(aggregates_.size());
  const int n = six + 6 * static_cast<int>(problem.dofs().bodies().size());
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(n, n);
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Matrix half;
  std::vector<std::pair<int, Modes>> columns;
  visit_reduced(problem, system_.state(), true, [&](std::span<const int> d, std::span<const double> K) {
    const int m = static_cast<int>(d.size());
    const Eigen::Map<const Matrix> full(K.data(), m, m);
    // blocks of rows: three of a node (its modes), or six of a body (itself)
    for (int j = 0; j < m;) {
      if (d[j] >= nodal) {
        const int column = six + d[j] - nodal;
        half = full.middleCols(j, 6);
        for (int i = 0; i < m;) {
          if (d[i] >= nodal) E.block<6, 6>(six + d[i] - nodal, column) += half.middleRows(i, 6), i += 6;
          else {
            if (const int a = of_[d[i] / 3]; a >= 0) E.block<6, 6>(6 * a, column) += modes(d[i] / 3).transpose() * half.middleRows(i, 3);
            i += 3;
          }
        }
        j += 6;
        continue;
      }
      j += 3;
    }
    // nodes against nodes (and bodies' rows against nodes' columns), gathered by aggregate to spare products
    columns.clear();
    for (int i = 0; i < m && d[i] < nodal; i += 3)
      if (of_[d[i] / 3] >= 0) columns.emplace_back(i, modes(d[i] / 3));
    for (std::size_t first = 0; first < columns.size(); ++first) {
      const int a = of_[d[columns[first].first] / 3];
      const bool seen = std::any_of(columns.begin(), columns.begin() + first, [&](const auto& c) { return of_[d[c.first] / 3] == a; });
      if (seen) continue;
      half.setZero(m, 6);
      for (const auto& [j, Z] : columns)
        if (of_[d[j] / 3] == a) half.noalias() += full.middleCols<3>(j) * Z;
      for (const auto& [i, Z] : columns) E.block<6, 6>(6 * of_[d[i] / 3], 6 * a).noalias() += Z.transpose() * half.middleRows<3>(i);
      for (int i = 0; i < m; ++i)
        if (d[i] >= nodal) E.block<1, 6>(six + d[i] - nodal, 6 * a) += half.row(i);
    }
  });
  problem.comm().sum(std::span(E.data(), E.size()));
  if (n > six) {
    for (const auto& e : system_.body_extra()) E(six + e.row, six + e.column) += e.value;
  }
  const double scale = E.diagonal().cwiseAbs().maxCoeff();
  for (int i = 0; i < n; ++i)
    if (std::abs(E(i, i)) < 1e-14 * scale && E.row(i).norm() < 1e-13 * scale) E(i, i) = scale;  // a dropped column
  return E;
}

void RigidCoarse::apply(std::span<const double> b, std::span<double> x) const {
  const LocalMesh& mesh = system_.problem().mesh();
  const int six = 6 * static_cast<int>(aggregates_.size());
  const int bodies = static_cast<int>(factor_.rows()) - six;
  Eigen::VectorXd coarse = Eigen::VectorXd::Zero(factor_.rows());
  for (int n = 0; n < mesh.owned; ++n)
    if (of_[n] >= 0) coarse.segment<6>(6 * of_[n]) += modes(n).transpose() * Eigen::Map<const Eigen::Vector3d>(&b[3 * n]);
  if (mesh.comm.rank() == 0)
    for (int i = 0; i < bodies; ++i) coarse[six + i] = b[3 * mesh.owned + i];
  mesh.comm.sum(std::span(coarse.data(), coarse.size()));
  coarse = factor_.solve(coarse);
  std::fill(x.begin(), x.end(), 0.0);
  for (int n = 0; n < mesh.owned; ++n)
    if (of_[n] >= 0) {
      Eigen::Map<Eigen::Vector3d> to(&x[3 * n]);
      to = modes(n) * coarse.segment<6>(6 * of_[n]);
    }
  if (mesh.comm.rank() == 0)
    for (int i = 0; i < bodies; ++i) x[3 * mesh.owned + i] = coarse[six + i];
}

std::size_t RigidCoarse::bytes() const {
  return bytes_of(of_) + bytes_of(aggregates_) + static_cast<std::size_t>(factor_.rows()) * factor_.rows() * sizeof(double);
}

}  // namespace bulbus
