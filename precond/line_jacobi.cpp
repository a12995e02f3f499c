#include "precond/line_jacobi.hpp"

#include <Eigen/Dense>
#include <unordered_map>

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus {
namespace {

using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The node after every local node on its line, as a local node; −1 at ends and where this rank does not have it.
std::vector<int> followers(const LocalMesh& mesh, const Lines& lines) {
  std::vector<int> next(mesh.nodes(), -1);
  for (int k = 0; k < lines.count(); ++k)
    for (int i = lines.start[k]; i + 1 < lines.start[k + 1]; ++i) next[lines.nodes[i]] = lines.nodes[i + 1];
  std::vector<double> number(mesh.nodes(), -1);
  for (int n = 0; n < mesh.owned; ++n)
    if (next[n] >= 0) number[n] = static_cast<double>(mesh.number[next[n]]);
  mesh.halo.update(number, 1);
  std::unordered_map<long long, int> ghost;
  for (int n = mesh.owned; n < mesh.nodes(); ++n) ghost[mesh.number[n]] = n;
  for (int n = mesh.owned; n < mesh.nodes(); ++n)
    if (const auto at = ghost.find(static_cast<long long>(number[n])); at != ghost.end()) next[n] = at->second;
  return next;
}

std::vector<double> couplings(const CoupledSystem& system, const Lines& lines) {
  LineCouplings c(system, lines);
  visit_reduced(system.problem(), system.state(), true, [&](std::span<const int> dofs, std::span<const double> K) { c.add(dofs, K); });
  return c.sum();
}

std::array<float, 6> packed(const Block& symmetric) {
  std::array<float, 6> p;
  for (int i = 0, k = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) p[k++] = static_cast<float>(symmetric(i, j));
  return p;
}

}  // namespace

LineCouplings::LineCouplings(const CoupledSystem& system, const Lines& lines)
    : mesh_(system.problem().mesh()), next_(followers(mesh_, lines)), ahead_(9 * static_cast<std::size_t>(mesh_.nodes())) {}

void LineCouplings::add(std::span<const int> d, std::span<const double> K) {
  const std::size_t n = d.size();
  const int nodal = 3 * mesh_.nodes();
  const auto width = [&](std::size_t i) { return d[i] < nodal ? 3 : 6; };  // of a node, of a rigid body
  for (std::size_t i = 0; i < n; i += width(i)) {
    if (d[i] >= nodal || next_[d[i] / 3] < 0) continue;
    for (std::size_t j = 0; j < n; j += width(j))
      if (d[j] == 3 * next_[d[i] / 3])
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) ahead_[3 * d[i] + 3 * r + c] += K[(i + r) * n + j + c];
  }
}

std::vector<double> LineCouplings::sum() {
  mesh_.halo.fold(ahead_, 9);
  return std::move(ahead_);
}

LineJacobi::LineJacobi(const CoupledSystem& system, const Lines& lines, const std::vector<double>& ahead)
    : size_(system.layout().primal()), lines_(lines), inverse_(lines.nodes.size()), lower_(lines.nodes.size() - lines.count()), bodies_(system) {
  for (int k = 0; k < lines.count(); ++k)
    if (!factorise(k, system.nodal_blocks(), ahead)) factorise_nodes(k, system.nodal_blocks());
}

LineJacobi::LineJacobi(const CoupledSystem& system, const Lines& lines) : LineJacobi(system, lines, couplings(system, lines)) {}

bool LineJacobi::factorise(int line, const std::vector<double>& diagonal, const std::vector<double>& ahead) {
  Block inverse;
  for (int i = lines_.start[line]; i < lines_.start[line + 1]; ++i) {
    const Block given = Eigen::Map<const Block>(&diagonal[9 * static_cast<std::size_t>(lines_.nodes[i])]);
    Block D = 0.5 * (given + given.transpose());
    if (i > lines_.start[line]) {
      const Block A = Eigen::Map<const Block>(&ahead[9 * static_cast<std::size_t>(lines_.nodes[i - 1])]).transpose();
      const Block L = A * inverse;
      D -= L * A.transpose();
      Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(lower_[i - line - 1].data()) = L.cast<float>();
    }
    const Eigen::LLT<Block> factor(D);
    if (factor.info() != Eigen::Success) return false;
    inverse = factor.solve(Block::Identity());
    inverse_[i] = packed(inverse);
  }
  return true;
}

void LineJacobi::factorise_nodes(int line, const std::vector<double>& diagonal) {
  for (int i = lines_.start[line]; i < lines_.start[line + 1]; ++i) {
    inverse_[i] = packed(safe_inverse<3>(Eigen::Map<const Eigen::Matrix3d>(&diagonal[9 * static_cast<std::size_t>(lines_.nodes[i])])));
    if (i > lines_.start[line]) lower_[i - line - 1].fill(0);
  }
}

// L D Lᵀ y = x along every line.
void LineJacobi::solve(const double* x, double* y, int stride) const {
  const auto node = [&](int i) { return stride * static_cast<std::size_t>(lines_.nodes[i]); };
  for (int k = 0; k < lines_.count(); ++k) {
    const int first = lines_.start[k], last = lines_.start[k + 1] - 1;
    for (int i = first; i <= last; ++i) {
      const double* b = &x[node(i)];
      double* to = &y[node(i)];
      for (int c = 0; c < 3; ++c) to[c] = b[c];
      if (i == first) continue;
      const auto& L = lower_[i - k - 1];
      const double* before = &y[node(i - 1)];
      for (int r = 0; r < 3; ++r) to[r] -= L[3 * r] * before[0] + L[3 * r + 1] * before[1] + L[3 * r + 2] * before[2];
    }
    for (int i = last; i >= first; --i) {
      double* to = &y[node(i)];
      const auto& D = inverse_[i];
      const double p = to[0], q = to[1], r = to[2];
      to[0] = D[0] * p + D[1] * q + D[2] * r;
      to[1] = D[1] * p + D[3] * q + D[4] * r;
      to[2] = D[2] * p + D[4] * q + D[5] * r;
      if (i == last) continue;
      const auto& L = lower_[i - k];
      const double* after = &y[node(i + 1)];
      for (int c = 0; c < 3; ++c) to[c] -= L[c] * after[0] + L[3 + c] * after[1] + L[6 + c] * after[2];
    }
  }
}

Eigen::MatrixXf LineJacobi::energy(int line, Rows& F) const {
  const int first = lines_.start[line], last = lines_.start[line + 1] - 1;
  Rows scaled(F.rows(), F.cols());
  for (int i = first; i <= last; ++i) {
    auto rows = F.middleRows<3>(3 * (i - first));
    if (i > first)
      rows -= Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(lower_[i - line - 1].data()).lazyProduct(F.middleRows<3>(3 * (i - first - 1)));
    const auto& d = inverse_[i];
    const Eigen::Matrix3f D{{d[0], d[1], d[2]}, {d[1], d[3], d[4]}, {d[2], d[4], d[5]}};
    scaled.middleRows<3>(3 * (i - first)) = D.lazyProduct(rows);
  }
  return F.transpose() * scaled;
}

void LineJacobi::apply(std::span<const double> x, std::span<double> y) const {
  solve(x.data(), y.data(), 3);
  bodies_.apply(x, y);
}

std::size_t LineJacobi::bytes() const { return bytes_of(inverse_) + bytes_of(lower_) + bodies_.bytes() + bytes_of(lines_.nodes) + bytes_of(lines_.start); }

}  // namespace bulbus
