#pragma once
#include <Eigen/Dense>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "precond/block_jacobi.hpp"
#include "precond/lines.hpp"

namespace bulbus {

/// The couplings along lines, accumulated contribution by contribution.
class LineCouplings {
 public:
  /// Collective.
  LineCouplings(const CoupledSystem& system, const Lines& lines);
  /// A contribution to the reduced displacement block (see visit_reduced).
  void add(std::span<const int> dofs, std::span<const double> K);
  /// A_(n, next) of every local node n with the next one on its line; 9 numbers by rows. Collective.
  std::vector<double> sum();

 private:
  const LocalMesh& mesh_;
  std::vector<int> next_;  // local node after every local node on its line; −1 at ends and where this rank does not have it
  std::vector<double> ahead_;
};

/// Inverses of the displacement block's parts on lines of nodes, block tridiagonal with 3×3 blocks, and on rigid bodies. A line
/// whose part is not positive definite falls back to its nodes' blocks, so that the result is symmetric positive.
class LineJacobi final : public Preconditioner {
 public:
  /// Collective.
  LineJacobi(const CoupledSystem& system, const Lines& lines);
  /// With the couplings that LineCouplings summed. Collective.
  LineJacobi(const CoupledSystem& system, const Lines& lines, const std::vector<double>& couplings);
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  /// The nodes' part, in place; four numbers per owned node, the last one unused.
  void apply_nodal(std::span<double> v) const { solve(v.data(), v.data(), 4); }
  int count() const { return lines_.count(); }
  /// Of one line.
  std::span<const int> nodes(int line) const { return std::span(lines_.nodes).subspan(lines_.start[line], lines_.start[line + 1] - lines_.start[line]); }
  /// Three rows per node of a line.
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// Fᵀ A⁻¹ F, A: the part on one line. F is used up.
  Eigen::MatrixXf energy(int line, Rows& F) const;
  bool fixed() const override { return true; }
  std::size_t bytes() const override;

 private:
  bool factorise(int line, const std::vector<double>& diagonal, const std::vector<double>& ahead);
  void factorise_nodes(int line, const std::vector<double>& diagonal);
  void solve(const double* x, double* y, int stride) const;

  int size_;
  const Lines& lines_;
  // Per position on a line: D_k⁻¹ (upper triangle) and, unless it is the first, L_k = A_(k,k−1) D_(k−1)⁻¹ by rows.
  std::vector<std::array<float, 6>> inverse_;
  std::vector<std::array<float, 9>> lower_;
  BodyBlocks bodies_;
};

}  // namespace bulbus
