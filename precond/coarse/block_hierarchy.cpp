#include "precond/coarse/block_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/memory.hpp"
#include "precond/coarse/aggregate_blocks.hpp"
#include "precond/smoothers/chebyshev.hpp"

namespace bulbus::inline precond {
namespace {

constexpr int blocks_of_aggregate = 6;
// Degree of the polynomial in a level's cycle: on the finest one it solves to a quarter where eigenvalues
// begin at .03 of the last (T_6(1.064) = 4.1; docs/decisions/052 compares degrees). A coarser level has a
// sixth of the rows and is visited so often for each cycle of the finer one, so that with more than six all
// of them would cost more than the finest.
constexpr int finest_degree = 6, coarser_degree = 4;
constexpr int lanczos_steps = 10;
// The spectrum of a cycle times a positive definite matrix ends at 1, or where the next level's polynomial
// lets it, and begins where Lanczos' method has come to, or a little below. A polynomial for less than the
// least would be too weak on all the rest. Outside of its interval it grows without bounds, so that it ends a
// little above what Lanczos' method has come to; where there are negative eigenvalues, or some beyond the
// farthest, the cycle stands alone. Where the matrix has a negative eigenvalue, however small, cycles end at
// 1.6 on the second of three levels of 470,000 hexahedra and are good all the same: 14 iterations with
// polynomials, more than 35 without (half eye, n = 56, first system).
constexpr double below = 0.7, least = 0.02, most = 0.5, above = 1.1, farthest = 3;
// Eigenvalue of a cycle times its matrix, which ends at 1 where sweeps are stable: along many rows one may
// blow up by orders of magnitude.
constexpr double unstable = 100;

Triplets triplets_of(const DistributedBlocks& blocks) {
  Triplets t;
  for (int i = 0; i < blocks.rows.mine; ++i)
    for (int k = 0; const int j : blocks.A.columns(i)) {
      const auto block = blocks.A.block(i, k++);
      for (int e = 0; e < 36; ++e) {
        t.row.push_back(static_cast<int>(6 * blocks.rows.global(i) + e / 6));
        t.col.push_back(static_cast<int>(6 * blocks.rows.global(j) + e % 6));
        t.value.push_back(block[e]);
      }
    }
  return t;
}

// A map of a level's vectors, which have room for ghosts, as one of this rank's parts.
template <class Base, class Map>
class OnOwnRows final : public Base {
 public:
  OnOwnRows(const BlockRows& rows, Map map)
      : in_(6 * rows.size()), out_(in_), mine_(6 * rows.mine), map_(map) {}
  int size() const override { return mine_; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::ranges::copy(x, in_.begin());
    map_(std::span(in_), std::span(out_));
    std::copy_n(out_.begin(), y.size(), y.begin());
  }
  bool is_linear() const { return true; }

 private:
  mutable std::vector<double> in_, out_;
  int mine_;
  Map map_;
};

template <class Base, class Map>
OnOwnRows<Base, Map> on_own_rows(const BlockRows& rows, Map map) {
  return {rows, map};
}

}  // namespace

BlockHierarchy::BlockHierarchy(DistributedBlocks finest, std::vector<RigidFrame> frames, int bodies,
                               double missing_diagonal, std::shared_ptr<HierarchyPlan> plan)
    : plan_(std::move(plan)) {
  levels_.push_back({.blocks = std::move(finest)});
  while (6 * levels_.back().blocks.rows.total > plan_->most) {
    const long long before = levels_.back().blocks.rows.total;
    coarsen(frames, bodies, missing_diagonal);
    if (3 * levels_.back().blocks.rows.total > 2 * before) break;
  }
  for (Level& l : levels_) {
    for (auto* own : {&l.b, &l.x, &l.r, &l.d, &l.Ad, &l.rest}) own->resize(6 * l.blocks.rows.mine);
    for (auto* with_ghosts : {&l.z, &l.step}) with_ghosts->resize(6 * l.blocks.rows.size());
  }
  factorise();
  for (std::size_t l = levels_.size() - 1; setup_error_.empty() && stable_ && l-- > 0;) set_polynomial(l);
}

void BlockHierarchy::coarsen(std::vector<RigidFrame>& frames, int bodies, double missing_diagonal) {
  const std::size_t level = levels_.size() - 1;
  Level& fine = levels_.back();
  if (plan_->groups.size() == level)
    plan_->groups.push_back(aggregate_blocks(fine.blocks.A, bodies, blocks_of_aggregate));
  fine.group = plan_->groups[level];
  CoarserModes modes = coarser_modes(frames, fine.group, bodies);
  fine.weights.resize(fine.group.size());
  for (std::size_t i = 0; i < fine.group.size(); ++i)
    for (int k = 0; k < 36; ++k) fine.weights[i][6 * (k % 6) + k / 6] = modes.weights[i][k];
  DistributedBlocks coarse = galerkin_product(plan_->comm, fine.blocks, fine.group, modes, missing_diagonal);
  frames = std::move(modes.frames);
  levels_.push_back({.blocks = std::move(coarse)});
}

void BlockHierarchy::factorise() {
  const DistributedBlocks& last = levels_.back().blocks;
  const FactorReport f = plan_->factor.factorise(triplets_of(last), 6 * last.rows.total, false);
  if (!f.ok) setup_error_ = "rigid motions of aggregates: " + f.reason;
  factor_bytes_ = static_cast<std::size_t>(f.memory_max_mb * 1e6);
}

void BlockHierarchy::set_polynomial(std::size_t level) {
  Level& l = levels_[level];
  const auto matrix =
      on_own_rows<LinearOperator>(l.blocks.rows, [&](std::span<double> x, std::span<double> y) {
        l.update_ghosts(x);
        l.blocks.A.apply(x, y);
      });
  const auto inverse = on_own_rows<Preconditioner>(
      l.blocks.rows, [&](std::span<double> b, std::span<double> x) { cycle(level, b, x); });
  const Spectrum spectrum = lanczos(matrix, inverse, lanczos_steps, plan_->comm);
  stable_ = stable_ && spectrum.smallest > -unstable && spectrum.largest < unstable;
  l.degree = spectrum.smallest > 0 && spectrum.largest < farthest
                 ? (level == 0 ? finest_degree : coarser_degree)
                 : 1;
  if (l.degree == 1) return;
  l.lowest = std::clamp(below * spectrum.smallest, least, most);
  l.highest = above * std::max(1.0, spectrum.largest);
}

void BlockHierarchy::restrict_to(std::size_t level, std::span<const double> fine) const {
  const Level& l = levels_[level - 1];
  auto& coarse = levels_[level].b;
  std::ranges::fill(coarse, 0.0);
  for (int i = 0; i < l.blocks.rows.mine; ++i)
    for (int k = 0; k < 6; ++k) {
      double sum = 0;
      for (int r = 0; r < 6; ++r) sum += l.weights[i][6 * k + r] * fine[6 * i + r];
      coarse[6 * l.group[i] + k] += sum;
    }
}

// Adds the solution of a level.
void BlockHierarchy::prolongate(std::size_t level, std::span<double> fine) const {
  const Level& l = levels_[level - 1];
  const auto& coarse = levels_[level].x;
  for (int i = 0; i < l.blocks.rows.mine; ++i)
    for (int k = 0; k < 6; ++k)
      for (int r = 0; r < 6; ++r) fine[6 * i + r] += l.weights[i][6 * k + r] * coarse[6 * l.group[i] + k];
}

// x with ghosts.
void BlockHierarchy::cycle(std::size_t level, std::span<const double> b, std::span<double> x) const {
  const Level& l = levels_[level];
  l.blocks.A.sweep_forwards(b, x, l.rest);
  l.update_ghosts(x);
  l.blocks.A.subtract_upper(x, l.rest);
  restrict_to(level + 1, l.rest);
  solve(level + 1);
  prolongate(level + 1, x);
  l.update_ghosts(x);
  l.blocks.A.sweep_backwards(b, x, l.step, l.rest);
}

// rest = b − A x of the last cycle.
void BlockHierarchy::complete_residual(std::size_t level) const {
  const Level& l = levels_[level];
  l.update_ghosts(l.step);
  l.blocks.A.subtract_lower(l.step, l.rest);
}

// x ≈ A⁻¹ b of a level. A d follows from the residuals of cycles, so that the matrix is read two and a half
// times for each of them: half in a sweep from zero and half for its residual, once in the sweep back and
// half for its residual.
void BlockHierarchy::solve(std::size_t level) const {
  const Level& l = levels_[level];
  if (level + 1 == levels_.size()) {
    plan_->factor.solve(l.b, l.x);
    return;
  }
  DampedSpectrum::Steps steps(l.lowest, l.highest);
  std::ranges::fill(l.x, 0.0);
  std::ranges::fill(l.d, 0.0);
  std::ranges::fill(l.Ad, 0.0);
  std::ranges::copy(l.b, l.r.begin());
  for (int k = 0; k < l.degree; ++k) {
    cycle(level, l.r, l.z);
    const auto [keep, add] = steps.next();
    for (std::size_t i = 0; i < l.d.size(); ++i) {
      l.d[i] = keep * l.d[i] + add * l.z[i];
      l.x[i] += l.d[i];
    }
    if (k + 1 == l.degree) break;
    complete_residual(level);
    for (std::size_t i = 0; i < l.d.size(); ++i) {
      l.Ad[i] = keep * l.Ad[i] + add * (l.r[i] - l.rest[i]);
      l.r[i] -= l.Ad[i];
    }
  }
}

void BlockHierarchy::apply(std::span<const double> b, std::span<double> x) const {
  const Level& first = levels_.front();
  std::ranges::copy(b, first.b.begin());
  solve(0);
  std::ranges::copy(first.x, x.begin());
}

std::size_t BlockHierarchy::bytes() const {
  std::size_t sum = factor_bytes_;
  for (const Level& l : levels_)
    sum +=
        l.blocks.A.bytes() + bytes_of(l.group) + bytes_of(l.weights) + 6 * bytes_of(l.b) + 2 * bytes_of(l.z);
  return sum;
}

}  // namespace bulbus::inline precond
