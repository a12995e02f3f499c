#pragma once
#include <Eigen/Dense>
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/reduced.hpp"
#include "precond/smoothers/block_jacobi.hpp"
#include "precond/smoothers/lines.hpp"

namespace bulbus::inline precond {

/// The displacement block's parts on lines, accumulated contribution by contribution.
class LineBlocks {
 public:
  /// Collective.
  LineBlocks(const CoupledSystem& system, const Lines& lines);
  /// A contribution to the reduced displacement block (see for_each_condensed_matrix).
  void add(std::span<const int> dofs, std::span<const double> K);
  /// Folds what other ranks have and puts constrained directions on constrained_diagonal(). Collective.
  void complete();
  /// A_(n, n) and A_(n, next) of every local node n with the next one on its line; 9 numbers by rows.
  std::span<const double> diagonal() const { return diagonal_; }
  std::span<const double> ahead() const { return ahead_; }

 private:
  const CoupledSystem& system_;
  const LocalMesh& mesh_;
  std::vector<int> next_;  // local node after every local node on its line; −1 at ends and where this rank
                           // does not have it
  std::vector<double> diagonal_, ahead_;
};

/// The element matrices that a preconditioner in this precision is made of.
inline Matrices matrices_of(Precision precision) {
  return precision == Precision::single ? Matrices::mean : Matrices::augmented;
}

/// Inverses of the displacement block's parts on lines of nodes, block tridiagonal with 3×3 blocks, and on
/// rigid bodies. A line whose part is not positive definite falls back to its nodes' blocks, so that the
/// result is symmetric positive.
class LineJacobi final : public Preconditioner {
 public:
  /// Collective.
  LineJacobi(const CoupledSystem& system, std::shared_ptr<const Lines> lines,
             Matrices matrices = Matrices::augmented);
  /// Of complete blocks.
  LineJacobi(const CoupledSystem& system, std::shared_ptr<const Lines> lines, const LineBlocks& blocks);
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  /// The nodes' part, in place, on owned nodes.
  void apply(std::span<NodeSingle> v) const;
  /// One step of a Chebyshev polynomial on owned nodes, with an application's forces z = A d, which become
  /// zero:
  ///     r −= z,   d ← keep d + add D⁻¹ r,   x += d
  void step(float keep, float add, std::span<NodeSingle> r, std::span<NodeSingle> z, std::span<NodeSingle> d,
            std::span<NodeSingle> x) const;
  const BodyBlocks& bodies() const { return bodies_; }
  const std::shared_ptr<const Lines>& lines() const { return lines_; }
  int count() const { return lines_->count(); }
  /// Of one line, or of several one after the other.
  std::span<const int> nodes(int line, int many = 1) const {
    return std::span(lines_->nodes)
        .subspan(lines_->start[line], lines_->start[line + many] - lines_->start[line]);
  }
  /// Three rows per node of a line.
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Fᵀ A⁻¹ F, A: the part on one line. F is used up.
  Eigen::MatrixXf energy(int line, Rows& F) const;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override;

 private:
  static constexpr int at_once = 4;  // lines that are solved side by side
  bool factorise(int line, const LineBlocks& blocks);
  void factorise_nodes(int line, const LineBlocks& blocks);
  template <class Number>
  void solve(int first, int many, Number* y, int stride) const;
  template <int Many, class Number>
  void solve(int first, Number* y, int stride) const;
  template <class Use>
  void for_each_group(Use use) const;

  int size_;
  std::shared_ptr<const Lines> lines_;
  // Per position on a line: D_k⁻¹ (upper triangle) and, unless it is the first, L_k = A_(k,k−1) D_(k−1)⁻¹ by
  // rows.
  std::vector<std::array<float, 6>> inverse_;
  std::vector<std::array<float, 9>> lower_;
  BodyBlocks bodies_;
  std::size_t longest_ = 0;  // nodes of a line
  mutable std::vector<NodeSingle> on_lines_;
};

}  // namespace bulbus::inline precond
