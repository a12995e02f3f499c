#pragma once
#include <memory>
#include <optional>
#include <span>

#include "precond/schur/line_pressure_stiffness.hpp"

namespace bulbus {

/// Part of an approximate inverse on the weak patterns of element pressures: a fixed symmetric linear map.
class SchurCorrection {
 public:
  virtual ~SchurCorrection() = default;
  /// z += weight · part · r. Collective.
  virtual void add(std::span<const double> r, double weight, std::span<double> z) = 0;
  /// Without K.
  virtual std::size_t bytes() const = 0;
};

/// R q(K) R on all pressures of a mesh of any kind; R takes smooth ones away (see OscillationFilter) but
/// where lines carry alone. K has to outlive it. Without a degree: from the mesh. Collective.
std::unique_ptr<SchurCorrection> rough_part(const CoupledSystem& system, const LineJacobi& lines,
                                            const LinePressureStiffness& K, std::optional<int> degree);

/// P q(Pᵀ K P) Pᵀ on the checkerboard modes (see CheckerboardModes) of hexahedra that were split once, in the
/// product of its factors. K has to outlive it. Without a degree: 16. Collective.
std::unique_ptr<SchurCorrection> fine_patterns_part(const CoupledSystem& system,
                                                    const LinePressureStiffness& K,
                                                    std::optional<int> degree);

/// P q(Pᵀ K P) Pᵀ with the matrix of the checkerboard modes of hexahedra that were split once or, where there
/// are such, twice. Keeps nothing of lines. Without a degree: from the mesh. Collective.
std::unique_ptr<SchurCorrection> coarse_patterns_part(const CoupledSystem& system, const LineJacobi& lines,
                                                      std::optional<int> degree);

}  // namespace bulbus
