#include "precond/amg/scalar_amg.hpp"

#include "core/base/memory.hpp"

namespace bulbus::inline precond {

ScalarAmg::ScalarAmg(const CoupledSystem& system, const std::array<DistributedCsr, 3>& matrices,
                     const Preconditioner& block_jacobi)
    : size_(system.layout().primal()),
      nodes_(system.layout().nodal / 3),
      block_jacobi_(block_jacobi),
      in_(nodes_),
      out_(nodes_) {
  // Thin layers: only neighbours through the thickness are strong. With aggressive coarsening on top, a third
  // less memory and half the set-up of threshold ¼, for as many iterations.
  const AmgOptions options{.threshold = 0.7, .aggressive_levels = 1};
  for (int c = 0; c < 3; ++c)
    amg_[c] = std::make_unique<BoomerAmg>(matrices[c], options, system.problem().comm());
}

void ScalarAmg::apply(std::span<const double> x, std::span<double> y) const {
  if (size_ > 3 * nodes_) block_jacobi_.apply(x, y);
  for (int c = 0; c < 3; ++c) {
    for (int n = 0; n < nodes_; ++n) in_[n] = x[3 * n + c];
    amg_[c]->apply(in_, out_);
    for (int n = 0; n < nodes_; ++n) y[3 * n + c] = out_[n];
  }
}

std::string ScalarAmg::setup_error() const {
  for (const auto& a : amg_)
    if (!a->failure().empty()) return "BoomerAMG: " + a->failure();
  return {};
}

std::size_t ScalarAmg::bytes() const {
  std::size_t total = bytes_of(in_) + bytes_of(out_);
  for (const auto& a : amg_) total += a->bytes();
  return total;
}

}  // namespace bulbus::inline precond
