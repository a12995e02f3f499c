#pragma once
#include <span>
#include <vector>

#include "core/base/tensor.hpp"
#include "core/element/contribution.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline element {

/// Straight bars, total Lagrangian, linear in Green strain, between points embedded in faces (or nodes):
///     d = x2 − x1,  e = (d·d − L²)/(2L²),  S = E e,  force on end 2 = A S d / L
class Bars {
 public:
  /// `X`: reference positions of the local nodes.
  Bars(std::span<const double> X, std::span<const Bar> bars, double E, double area, bool tension_only);

  void add_residual(std::span<const double> x, std::span<double> force,
                    std::span<double> reference_force) const;
  void add_stiffness(std::span<const double> x, std::span<const double> dx, std::span<double> out) const;
  void visit(std::span<const double> x, const ContributionVisitor& visitor) const;
  /// Axial force A S |d| / L of every bar (N).
  std::vector<double> forces(std::span<const double> x) const;
  std::span<const Bar> bars() const { return bars_; }

 private:
  struct Pull {
    Vec3<double> d;
    double stretch_stiffness, tension;  // A E / L³ and A S / L
  };
  Pull pull(std::span<const double> x, std::size_t i) const;

  std::vector<Bar> bars_;
  std::vector<double> length_;
  double E_, area_;
  bool tension_only_;
};

/// Place of an embedded point.
Vec3<double> place(const EmbeddedPoint& p, std::span<const double> x);

}  // namespace bulbus::inline element
