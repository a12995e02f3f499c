#pragma once
#include <memory>
#include <optional>
#include <span>

#include "precond/schur/line_pressure_stiffness.hpp"

namespace bulbus::inline precond {

/// Part of an approximate inverse on oscillating element pressures, checkerboard modes among them: a fixed
/// symmetric linear map.
class SchurCorrection {
 public:
  virtual ~SchurCorrection() = default;
  /// z += weight · part · r. Collective.
  virtual void add(std::span<const double> r, double weight, std::span<double> z) = 0;
  /// Without K.
  virtual std::size_t bytes() const = 0;
};

/// R q(K) R on all pressures of a mesh of any kind; R takes smooth ones away (see OscillationFilter) but
/// where lines carry alone. Without a degree: from the mesh, and half of it unless a solve is to gain
/// `many_digits`: more than a Newton step asks for by default (least_of_plain_method). Collective.
std::unique_ptr<SchurCorrection> oscillation_correction(const CoupledSystem& system, const LineJacobi& lines,
                                                        std::shared_ptr<const LinePressureStiffness> K,
                                                        std::optional<int> degree, bool many_digits);

/// P q(Pᵀ K P) Pᵀ on the checkerboard modes (see CheckerboardModes) of hexahedra that were split once, in the
/// product of its factors. Without a degree: 16. Collective.
std::unique_ptr<SchurCorrection> fine_checkerboard_correction(const CoupledSystem& system,
                                                              std::shared_ptr<const LinePressureStiffness> K,
                                                              std::optional<int> degree);

/// P q(Pᵀ K P) Pᵀ with the matrix of the checkerboard modes of hexahedra that were split once or, where there
/// are such, twice. Keeps nothing of lines. Without a degree: from the mesh. Collective.
std::unique_ptr<SchurCorrection> coarse_checkerboard_correction(const CoupledSystem& system,
                                                                const LineJacobi& lines,
                                                                std::optional<int> degree);

}  // namespace bulbus::inline precond
