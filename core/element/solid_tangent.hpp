#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/memory.hpp"
#include "core/element/contribution.hpp"
#include "core/element/mean_tangent.hpp"
#include "core/element/solid.hpp"

namespace bulbus::inline element {

/// How the tangent gets the strain at its Gauss points: caching it, or computing it anew at every
/// application.
enum class StrainSource { recompute, cache };

/// Numbers that do not change, shared by all that need them.
using SharedNumbers = std::shared_ptr<const std::vector<double>>;

/// The tangent of a Solid in one state, a value: K, the constraints b_e = ∂V_e/∂u and their augmentation
/// γ b W bᵀ. It shares solid and state, so that it can be applied as long as it lives. Vectors as those of a
/// Solid.
class SolidTangent {
 public:
  /// At the places `x` and the element pressures `lambda`. `gamma` augments: penalty_e = γ μ_e / V0_e with
  /// the current μ_e = 2 (W1 + W2), floored at a tenth of the initial one.
  SolidTangent(std::shared_ptr<const Solid> solid, SharedNumbers x, SharedNumbers lambda, double gamma,
               StrainSource source);

  const Solid& solid() const { return *solid_; }

  /// force += (K + γ b W bᵀ) dx + b dlambda; volume_change = bᵀ dx. An empty dlambda counts as zero, an empty
  /// volume_change is not written.
  void apply(std::span<const double> dx, std::span<const double> dlambda, std::span<double> force,
             std::span<double> volume_change) const;
  /// force += (K + γ b W bᵀ) dx in single precision and with the mean of K over every hexahedron (see
  /// MeanTangent): for smoothers. A node each; a translation on top of the strain costs floats accuracy.
  void apply_single(std::span<const NodeSingle> dx, std::span<NodeSingle> force) const;
  /// force += b dlambda and volume_change = bᵀ dx in single precision.
  void apply_pressure_single(std::span<const double> dlambda, std::span<NodeSingle> force) const;
  void volume_change_single(std::span<const NodeSingle> dx, std::span<double> volume_change) const;
  /// volume_change = bᵀ dx.
  void volume_change(std::span<const double> dx, std::span<double> volume_change) const;
  /// force += b dlambda.
  void apply_pressure(std::span<const double> dlambda, std::span<double> force) const;

  /// Current shear modulus per hexahedron (MPa), floored.
  std::span<const double> shear_moduli() const { return mu_; }
  /// γ μ_e / V0_e per hexahedron.
  std::span<const double> penalties() const { return penalty_; }

  /// Element matrices, augmentation included where `augmented`.
  void visit(const ContributionVisitor& visitor, bool augmented) const;
  /// The matrices that apply_single() stands for, with this part of the augmentation, in a fifth of the time.
  void visit_mean(const ContributionVisitor& visitor, double augmentation = 1) const;
  /// b_e of every hexahedron: 8 local nodes, 24 numbers.
  void visit_constraints(
      const std::function<void(int hex, std::span<const int> nodes, std::span<const double> b)>&) const;

  /// Without solid and state.
  std::size_t bytes() const;
  /// What it keeps of every Gauss point and every hexahedron to be applied faster.
  std::size_t cache_bytes() const;

 private:
  void compute_moduli(double gamma);
  void fill_cache();
  void round_places() const;
  void fill_tangents() const;
  template <class Body>
  void for_each_pair(Body body) const;

  std::shared_ptr<const Solid> solid_;
  SharedNumbers x_, lambda_;
  std::vector<double> mu_, penalty_;
  std::vector<float, LargePages<float>> cache_;  // empty where strains are recomputed
  struct Single {                                // empty until it is asked for
    std::vector<NodeSingle> x;
    std::vector<SingleTangent, LargePages<SingleTangent>> tangents;
  };
  mutable Single single_;
  StrainSource source_;
};

}  // namespace bulbus::inline element
