#pragma once
#include <span>
#include <vector>

#include "precond/smoothers/line_jacobi.hpp"

namespace bulbus::inline precond {

/// R p = p − E N⁻¹ Eᵀ p / 8, tissue by tissue: takes away the means over a hexahedron's nodes of the means
/// over the hexahedra of its region around them. Checkerboard modes have none. Symmetric. Hexahedra that are
/// let through keep their pressure and do not count in means.
class OscillationFilter {
 public:
  /// `let_through`: of every hexahedron; empty: none.
  explicit OscillationFilter(const Problem& problem, std::vector<char> let_through = {});
  /// In place. Collective.
  void apply(std::span<double> p) const;
  std::size_t bytes() const;

 private:
  const LocalMesh& mesh_;
  std::span<const SolidRegion> regions_;
  std::vector<char> let_through_;
  mutable std::vector<double> nodal_;
};

/// The hexahedra whose lines carry a load without their neighbours, as in a film between two glued faces; 1
/// or 0 for each of this rank's. There the lines' part of the displacement block is all of it, and smooth
/// pressures are as weak as its Schur complement says. Collective.
std::vector<char> carried_by_lines(const CoupledSystem& system, const LineJacobi& lines);

}  // namespace bulbus::inline precond
