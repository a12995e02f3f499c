#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/material/material.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Drucker's criterion for an incompressible isotropic law: does dτ : dε > 0 hold for all isochoric strain
/// increments, τ the Kirchhoff stress and ε the logarithmic strain? It is the positive definite Hessian of W
/// in two logarithmic stretches. `stretches`: principal ones, of product 1.
bool is_stable(const Material& material, const std::array<double, 3>& stretches);

/// The homogeneous deformation nearest to none in which a law loses stability.
struct StabilityLimit {
  std::string mode;    ///< "uniaxial", "equibiaxial" or "planar"
  double stretch = 1;  ///< in the loaded direction or directions
};
/// Limits between the stretches 0.4 and 3, at most one a mode and direction of loading (tension,
/// compression).
std::vector<StabilityLimit> stability_limits(const Material& material);

/// A sentence for every region whose law loses stability between the stretches 0.4 and 3.
std::vector<std::string> unstable_regions(const Model& model);

}  // namespace bulbus::inline problem
