#pragma once
#include <array>
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "precond/amg/boomeramg.hpp"

namespace bulbus::inline precond {

/// One BoomerAMG V-cycle on each of the three scalar diagonal blocks A_xx, A_yy, A_zz, which are accumulated
/// element by element: the full matrix is never formed. Rigid bodies are left to block Jacobi.
class ScalarAmg final : public Preconditioner {
 public:
  ScalarAmg(const CoupledSystem& system, const std::array<DistributedCsr, 3>& matrices,
            const Preconditioner& block_jacobi);
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool is_linear() const override { return true; }
  std::string setup_error() const override;
  std::size_t bytes() const override;

 private:
  int size_, nodes_;
  const Preconditioner& block_jacobi_;
  std::array<std::unique_ptr<BoomerAmg>, 3> amg_;
  mutable std::vector<double> in_, out_;
};

}  // namespace bulbus::inline precond
