#pragma once
#include <memory>
#include <vector>

#include "core/solve/linear_operator.hpp"
#include "core/solve/mumps.hpp"
#include "precond/coarse/distributed_blocks.hpp"
#include "precond/coarse/rigid_modes.hpp"

namespace bulbus::inline precond {

/// What the levels keep from one linearisation to the next.
struct HierarchyPlan {
  /// `most_unknowns`: of a matrix that is factorised. Collective.
  HierarchyPlan(const Comm& c, int most_unknowns) : comm(c), most(most_unknowns), factor(c) {}
  Comm comm;
  int most;
  std::vector<std::vector<int>> groups;  ///< level by level, the aggregate of each of this rank's rows
  Mumps factor;                          ///< of the last level
};

/// Aggregates of aggregates: an approximate inverse of the matrix of rigid-body modes, in double precision,
/// since bending modes of a thin wall have energies that single precision does not hold.
/// Every level has the rigid motions of its aggregates as unknowns, six each (Vaněk, Mandel and Brezina,
/// Computing 56, 1996, with prolongations that are not smoothed). A cycle is one sweep of block Gauss–Seidel,
/// the correction by the next level and a sweep back; in place of the K-cycle's Krylov method (Notay and
/// Vassilevski, NLAA 15, 2008) a level takes a fixed Chebyshev polynomial in its cycle, so that the whole
/// stays one linear map. The last level is factorised. Aggregates and sweeps end at the ranks' boundaries.
class BlockHierarchy final : public Preconditioner {
 public:
  /// `frames`: of the aggregates that are this rank's block rows of `finest`, the first `bodies` of which are
  /// rigid bodies and stay as they are on every level. `missing_diagonal`: of modes that move nothing.
  /// Collective.
  BlockHierarchy(DistributedBlocks finest, std::vector<RigidFrame> frames, int bodies,
                 double missing_diagonal, std::shared_ptr<HierarchyPlan> plan);
  int size() const override { return 6 * levels_.front().blocks.rows.mine; }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool is_linear() const override { return true; }
  std::string setup_error() const override { return setup_error_; }
  std::size_t bytes() const override;
  /// False where the matrix is so indefinite that a cycle enlarges errors many times: another solver is
  /// called for.
  bool stable() const { return stable_; }
  int levels() const { return static_cast<int>(levels_.size()); }

 private:
  using Weights = std::array<double, 36>;  // by columns
  struct Level {
    DistributedBlocks blocks;
    std::vector<int> group;                     // empty on the last level
    std::vector<Weights> weights;               // of this rank's rows: their modes in those of their group
    int degree = 1;                             // of the polynomial
    double lowest = 1, highest = 1;             // of the spectrum that it damps
    mutable std::vector<double> b, x;           // right-hand side and solution
    mutable std::vector<double> r, d, Ad;       // of the polynomial
    mutable std::vector<double> z, step, rest;  // of the cycle, the first two with ghosts
    void update_ghosts(std::span<double> v) const { blocks.rows.halo.update_ghosts(v, 6); }
  };

  void coarsen(std::vector<RigidFrame>& frames, int bodies, double missing_diagonal);
  void factorise();
  void set_polynomial(std::size_t level);
  void solve(std::size_t level) const;
  void cycle(std::size_t level, std::span<const double> b, std::span<double> x) const;
  void complete_residual(std::size_t level) const;
  void restrict_to(std::size_t level, std::span<const double> fine) const;
  void prolongate(std::size_t level, std::span<double> fine) const;

  std::shared_ptr<HierarchyPlan> plan_;
  std::vector<Level> levels_;
  std::string setup_error_;
  bool stable_ = true;
  std::size_t factor_bytes_ = 0;
};

}  // namespace bulbus::inline precond
