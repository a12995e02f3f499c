#include "precond/smoothers/line_jacobi.hpp"

#include <Eigen/Dense>
#include <unordered_map>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {
namespace {

using Block = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The node after every local node on its line, as a local node; −1 at ends and where this rank does not have
// it.
std::vector<int> followers(const LocalMesh& mesh, const Lines& lines) {
  std::vector<int> next(mesh.nodes(), -1);
  for (int k = 0; k < lines.count(); ++k)
    for (int i = lines.start[k]; i + 1 < lines.start[k + 1]; ++i) next[lines.nodes[i]] = lines.nodes[i + 1];
  std::vector<double> number(mesh.nodes(), -1);
  for (int n = 0; n < mesh.owned; ++n)
    if (next[n] >= 0) number[n] = static_cast<double>(mesh.number[next[n]]);
  mesh.halo.update_ghosts(number, 1);
  std::unordered_map<long long, int> ghost;
  for (int n = mesh.owned; n < mesh.nodes(); ++n) ghost[mesh.number[n]] = n;
  for (int n = mesh.owned; n < mesh.nodes(); ++n)
    if (const auto at = ghost.find(static_cast<long long>(number[n])); at != ghost.end())
      next[n] = at->second;
  return next;
}

LineBlocks blocks_of(const CoupledSystem& system, const Lines& lines, Matrices matrices) {
  LineBlocks blocks(system, lines);
  for_each_condensed_matrix(
      system, matrices, [&](std::span<const int> dofs, std::span<const double> K) { blocks.add(dofs, K); });
  blocks.complete();
  return blocks;
}

Block block_at(std::span<const double> blocks, int node) {
  return Eigen::Map<const Block>(&blocks[9 * static_cast<std::size_t>(node)]);
}

std::array<float, 6> packed(const Block& symmetric) {
  std::array<float, 6> p;
  for (int i = 0, k = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) p[k++] = static_cast<float>(symmetric(i, j));
  return p;
}

}  // namespace

LineBlocks::LineBlocks(const CoupledSystem& system, const Lines& lines)
    : system_(system),
      mesh_(system.problem().mesh()),
      next_(followers(mesh_, lines)),
      diagonal_(9 * static_cast<std::size_t>(mesh_.nodes())),
      ahead_(diagonal_.size()) {}

void LineBlocks::add(std::span<const int> d, std::span<const double> K) {
  const std::size_t n = d.size();
  const int nodal = 3 * mesh_.nodes();
  const auto width = [&](std::size_t i) { return d[i] < nodal ? 3 : 6; };  // of a node, of a rigid body
  const auto add_block = [&](std::size_t i, std::size_t j, double* to) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) to[3 * r + c] += K[(i + r) * n + j + c];
  };
  for (std::size_t i = 0; i < n; i += width(i)) {
    if (d[i] >= nodal) continue;
    add_block(i, i, &diagonal_[3 * static_cast<std::size_t>(d[i])]);
    if (const int next = next_[d[i] / 3]; next >= 0)
      for (std::size_t j = 0; j < n; j += width(j))
        if (d[j] == 3 * next) add_block(i, j, &ahead_[3 * static_cast<std::size_t>(d[i])]);
  }
}

void LineBlocks::complete() {
  mesh_.halo.accumulate_ghosts(diagonal_, 9);
  mesh_.halo.accumulate_ghosts(ahead_, 9);
  system_.add_constrained_blocks(diagonal_);
}

LineJacobi::LineJacobi(const CoupledSystem& system, std::shared_ptr<const Lines> lines,
                       const LineBlocks& blocks)
    : size_(system.layout().primal()),
      lines_(std::move(lines)),
      inverse_(lines_->nodes.size()),
      lower_(lines_->nodes.size() - lines_->count()),
      bodies_(system) {
  for (int k = 0; k < count(); ++k) {
    if (!factorise(k, blocks)) factorise_nodes(k, blocks);
    longest_ = std::max(longest_, nodes(k).size());
  }
  on_lines_.resize(at_once * longest_);
}

LineJacobi::LineJacobi(const CoupledSystem& system, std::shared_ptr<const Lines> lines, Matrices matrices)
    : LineJacobi(system, lines, blocks_of(system, *lines, matrices)) {}

bool LineJacobi::factorise(int line, const LineBlocks& blocks) {
  Block inverse;
  for (int i = lines_->start[line]; i < lines_->start[line + 1]; ++i) {
    const Block given = block_at(blocks.diagonal(), lines_->nodes[i]);
    Block D = 0.5 * (given + given.transpose());
    if (i > lines_->start[line]) {
      const Block A = block_at(blocks.ahead(), lines_->nodes[i - 1]).transpose();
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

void LineJacobi::factorise_nodes(int line, const LineBlocks& blocks) {
  for (int i = lines_->start[line]; i < lines_->start[line + 1]; ++i) {
    inverse_[i] = packed(safe_inverse<3>(Eigen::Matrix3d(block_at(blocks.diagonal(), lines_->nodes[i]))));
    if (i > lines_->start[line]) lower_[i - line - 1].fill(0);
  }
}

// use(first line, how many): neighbours of one length at once, or one line alone.
template <class Use>
void LineJacobi::for_each_group(Use use) const {
  const auto size = [&](int line) { return lines_->start[line + 1] - lines_->start[line]; };
  for (int k = 0; k < count();) {
    int same = 1;
    while (same < at_once && k + same < count() && size(k + same) == size(k)) ++same;
    if (same < at_once) same = 1;
    use(k, same);
    k += same;
  }
}

// L D Lᵀ y = y of lines of one length, the nodes of a line one after the other. Each waits for the one
// before; several lines do not wait for each other.
template <int Many, class Number>
void LineJacobi::solve(int first, Number* y, int stride) const {
  const int count = lines_->start[first + 1] - lines_->start[first];
  const std::array<float, 9>* L[Many];
  const std::array<float, 6>* D[Many];
  Number* of[Many];
  for (int m = 0; m < Many; ++m) {
    L[m] = lower_.data() + lines_->start[first + m] - (first + m);
    D[m] = inverse_.data() + lines_->start[first + m];
    of[m] = y + static_cast<std::ptrdiff_t>(stride) * count * m;
  }
  for (int i = 1; i < count; ++i)
    for (int m = 0; m < Many; ++m) {
      const auto& l = L[m][i - 1];
      const Number* before = of[m] + stride * (i - 1);
      Number* to = of[m] + stride * i;
      for (int r = 0; r < 3; ++r)
        to[r] -= l[3 * r] * before[0] + l[3 * r + 1] * before[1] + l[3 * r + 2] * before[2];
    }
  for (int i = count - 1; i >= 0; --i)
    for (int m = 0; m < Many; ++m) {
      const auto& d = D[m][i];
      Number* to = of[m] + stride * i;
      const Number p = to[0], q = to[1], r = to[2];
      to[0] = d[0] * p + d[1] * q + d[2] * r;
      to[1] = d[1] * p + d[3] * q + d[4] * r;
      to[2] = d[2] * p + d[4] * q + d[5] * r;
      if (i + 1 == count) continue;
      const auto& l = L[m][i];
      const Number* after = to + stride;
      for (int c = 0; c < 3; ++c) to[c] -= l[c] * after[0] + l[3 + c] * after[1] + l[6 + c] * after[2];
    }
}

// many: as for_each_group has it.
template <class Number>
void LineJacobi::solve(int first, int many, Number* y, int stride) const {
  many == 1 ? solve<1>(first, y, stride) : solve<at_once>(first, y, stride);
}

void LineJacobi::apply(std::span<const double> x, std::span<double> y) const {
  std::vector<double> on_lines(3 * at_once * longest_);
  for_each_group([&](int k, int many) {
    const auto group = nodes(k, many);
    for (std::size_t i = 0; i < group.size(); ++i)
      std::copy_n(&x[3 * static_cast<std::size_t>(group[i])], 3, &on_lines[3 * i]);
    solve(k, many, on_lines.data(), 3);
    for (std::size_t i = 0; i < group.size(); ++i)
      std::copy_n(&on_lines[3 * i], 3, &y[3 * static_cast<std::size_t>(group[i])]);
  });
  const std::size_t nodal = 3 * lines_->nodes.size();
  bodies_.apply(x.subspan(nodal), y.subspan(nodal));
}

void LineJacobi::apply(std::span<NodeSingle> v) const {
  for_each_group([&](int k, int many) {
    const auto group = nodes(k, many);
    for (std::size_t i = 0; i < group.size(); ++i) on_lines_[i] = v[group[i]];
    solve(k, many, numbers(on_lines_).data(), 4);
    for (std::size_t i = 0; i < group.size(); ++i) v[group[i]] = on_lines_[i];
  });
}

void LineJacobi::step(float keep, float add, std::span<NodeSingle> r, std::span<NodeSingle> z,
                      std::span<NodeSingle> d, std::span<NodeSingle> x) const {
  constexpr std::size_t ahead = 12;  // nodes, whose numbers are soon to be asked for
  const std::size_t last = lines_->nodes.size() - 1;
  for_each_group([&](int k, int many) {
    const auto group = nodes(k, many);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int n = group[i], soon = lines_->nodes[std::min(lines_->start[k] + i + ahead, last)];
      for (const auto& v : {r, z, d, x}) __builtin_prefetch(&v[soon], 1);
      on_lines_[i] = r[n] -= z[n];
      z[n] = NodeSingle{};
    }
    solve(k, many, numbers(on_lines_).data(), 4);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int n = group[i];
      d[n] = keep * d[n] + add * on_lines_[i];
      x[n] += d[n];
    }
  });
}

Eigen::MatrixXf LineJacobi::energy(int line, Rows& F) const {
  const int first = lines_->start[line], last = lines_->start[line + 1] - 1;
  Rows scaled(F.rows(), F.cols());
  for (int i = first; i <= last; ++i) {
    auto rows = F.middleRows<3>(3 * (i - first));
    if (i > first)
      rows -= Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(lower_[i - line - 1].data())
                  .lazyProduct(F.middleRows<3>(3 * (i - first - 1)));
    const auto& d = inverse_[i];
    const Eigen::Matrix3f D{{d[0], d[1], d[2]}, {d[1], d[3], d[4]}, {d[2], d[4], d[5]}};
    scaled.middleRows<3>(3 * (i - first)) = D.lazyProduct(rows);
  }
  return F.transpose() * scaled;
}

std::size_t LineJacobi::bytes() const {
  return bytes_of(inverse_) + bytes_of(lower_) + bodies_.bytes() + bytes_of(lines_->nodes) +
         bytes_of(lines_->start);
}

}  // namespace bulbus::inline precond
