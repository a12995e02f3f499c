#pragma once
#include <deque>
#include <span>
#include <vector>

#include "core/base/parallel.hpp"

namespace bulbus::inline solve {

/// Anderson's acceleration of a fixed point x = x + f(x) (Anderson, J. ACM 12, 1965; type II of Fang and
/// Saad, Numer. Linear Algebra Appl. 16, 2009):
///     x ← x + f − Σ γ_i (Δx_i + Δf_i),   γ = argmin ‖f − Σ γ_i Δf_i‖
/// over the last `depth` differences. Vectors of one rank; the first `owned` numbers count in the norm.
class AndersonAcceleration {
 public:
  AndersonAcceleration(int depth, std::size_t owned, const Comm& comm)
      : depth_(depth), owned_(owned), comm_(comm) {}

  /// The next iterate, given the present one and what the fixed point would add to it. Collective.
  std::vector<double> next(std::span<const double> x, std::span<const double> f);
  /// Begins anew.
  void forget() { differences_.clear(), x_.clear(), f_.clear(); }

 private:
  struct Difference {
    std::vector<double> x, f;
  };
  void add(std::span<const double> x, std::span<const double> f);
  std::vector<double> coefficients(std::span<const double> f) const;

  int depth_;
  std::size_t owned_;
  Comm comm_;
  std::deque<Difference> differences_;
  std::vector<double> x_, f_;
};

}  // namespace bulbus::inline solve
