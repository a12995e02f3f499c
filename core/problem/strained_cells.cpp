#include "core/problem/strained_cells.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "core/problem/material_stability.hpp"

namespace bulbus::inline problem {
namespace {

// Σ x_n ⊗ ∂N_n/∂ξ in the middle of a hexahedron, times 8.
Eigen::Matrix3d jacobian(const Hex& hex, std::span<const double> x) {
  constexpr int xi[8] = {-1, 1, 1, -1, -1, 1, 1, -1}, eta[8] = {-1, -1, 1, 1, -1, -1, 1, 1},
                zeta[8] = {-1, -1, -1, -1, 1, 1, 1, 1};
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 8; ++n)
    for (int c = 0; c < 3; ++c) J.row(c) += x[3 * hex[n] + c] * Eigen::RowVector3d(xi[n], eta[n], zeta[n]);
  return J;
}

// Isochoric principal stretches.
std::array<double, 3> stretches(const LocalMesh& mesh, int h, std::span<const double> x) {
  const Eigen::Matrix3d F = jacobian(mesh.hexes[h], x) * jacobian(mesh.hexes[h], mesh.X).inverse();
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(F * F.transpose()).eigenvalues();
  const double J = std::cbrt(std::sqrt(std::max(squares.prod(), 1e-300)));
  return {std::sqrt(std::max(squares[0], 1e-300)) / J, std::sqrt(squares[1]) / J, std::sqrt(squares[2]) / J};
}

}  // namespace

StrainedCells strained_cells(const Problem& problem, std::span<const double> x) {
  const LocalMesh& mesh = problem.mesh();
  StrainedCells found;
  for (const SolidRegion& r : problem.solid().regions()) {
    if (!found.unstable_region.empty() || std::holds_alternative<NeoHooke>(r.material))
      continue;  // a neo-Hookean law is stable everywhere
    long long count = 0;
    for (int h = r.first; h < r.first + r.count; ++h) count += !is_stable(r.material, stretches(mesh, h, x));
    if (count = mesh.comm.sum(count); count > 0) found.unstable_region = r.name, found.unstable = count;
  }
  int hex = -1;
  const double least = problem.solid().least_jacobian(x, &hex);
  found.least_jacobian = mesh.comm.min(least);
  const bool mine = least == found.least_jacobian && hex >= 0;
  found.squeezed = std::llround(mesh.comm.max(mine ? mesh.input_hex[hex] + 1.0 : 0.0));
  double region = -1;
  for (std::size_t r = 0; mine && r < mesh.regions.size(); ++r)
    if (hex >= mesh.regions[r].first && hex < mesh.regions[r].first + mesh.regions[r].count)
      region = static_cast<double>(r);
  region = mesh.comm.max(region);
  if (region >= 0) found.squeezed_region = mesh.region_names[static_cast<int>(region)];
  return found;
}

}  // namespace bulbus::inline problem
