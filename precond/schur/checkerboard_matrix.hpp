#pragma once
#include <memory>
#include <vector>

#include "core/base/pack.hpp"
#include "core/mesh/distributed/halo.hpp"
#include "core/solve/linear_operator.hpp"
#include "precond/schur/checkerboard_modes.hpp"
#include "precond/schur/line_pressure_stiffness.hpp"

namespace bulbus::inline precond {

/// Pᵀ K P, blocks of pairs of coarser hexahedra; stored in single precision.
class CheckerboardMatrix final : public LinearOperator {
 public:
  /// Keeps nothing of `system` and `lines`. Collective.
  CheckerboardMatrix(const CoupledSystem& system, std::shared_ptr<const CheckerboardModes> modes,
                     const LineJacobi& lines);
  int size() const override { return modes_->size(); }
  /// Collective.
  void apply(std::span<const double> x, std::span<double> y) const override;
  /// Leaves out blocks whose norm is below this part of their two hexahedra's own. Collective.
  void drop(double part);
  /// Of a coarser hexahedron.
  int modes() const { return modes_->count(); }
  /// Blocks of every coarser hexahedron with itself. Collective.
  std::vector<double> diagonal() const;
  std::size_t bytes() const;

 private:
  struct Pair {
    int row, column;  // row ≤ column
    auto operator<=>(const Pair&) const = default;
  };
  class Assembly;
  template <int N>
  void multiply(std::span<double> x) const;  // x ← K x without halos, N modes
  template <int N>
  void add_products() const;

  std::shared_ptr<const CheckerboardModes> modes_;
  std::vector<Pair> pairs_;                           // ascending
  std::vector<float> blocks_;                         // of the pairs, by rows
  std::unique_ptr<Halo> halo_;                        // of coarser hexahedra, ghosts behind this rank's
  mutable std::vector<SinglePack::Vector> in_, out_;  // a vector for a coarser hexahedron
  mutable std::vector<double> exchanged_;
};

/// Inverses of a CheckerboardMatrix's diagonal blocks; zero where nothing moves.
class CheckerboardJacobi final : public Preconditioner {
 public:
  /// Collective.
  explicit CheckerboardJacobi(const CheckerboardMatrix& matrix);
  int size() const override { return size_; }
  void apply(std::span<const double> r, std::span<double> z) const override;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override;

 private:
  int modes_, size_;
  std::vector<float> inverse_;
};

/// Pᵀ K P as the product of its factors.
class CheckerboardProduct final : public LinearOperator {
 public:
  CheckerboardProduct(std::shared_ptr<const CheckerboardModes> modes,
                      std::shared_ptr<const LinePressureStiffness> K)
      : modes_(std::move(modes)), K_(std::move(K)), p_(K_->size()), q_(K_->size()) {}
  int size() const override { return modes_->size(); }
  /// Collective.
  void apply(std::span<const double> x, std::span<double> y) const override;
  std::size_t bytes() const;

 private:
  std::shared_ptr<const CheckerboardModes> modes_;
  std::shared_ptr<const LinePressureStiffness> K_;
  mutable std::vector<double> p_, q_;
};

}  // namespace bulbus::inline precond
