#include "core/problem/coarse_positions.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace bulbus::inline problem {
namespace {

constexpr double least = 0.3;  // J (formulation, section 9.4; docs/decisions/015)
// Each reaches one hexahedron farther; what is inverted then is left as it is.
constexpr int most_passes = 50;

// Of this rank's nodes, ghosts included: is there a hexahedron around it that is nearly inverted?
std::vector<double> nodes_of_inverted(const Problem& problem, std::span<const double> x) {
  const LocalMesh& mesh = problem.mesh();
  const auto J = problem.solid().least_jacobians(x);
  std::vector<double> found(mesh.nodes());
  for (std::size_t h = 0; h < J.size(); ++h)
    if (!(J[h] >= least))
      for (int n : mesh.hexes[h]) found[n] = 1;
  mesh.halo.accumulate_ghosts(found, 1);
  mesh.halo.update_ghosts(found, 1);
  return found;
}

// Mean over the hexahedra around every owned node of the means of their nodes' displacements.
std::vector<double> mean_displacements(const LocalMesh& mesh, std::span<const double> x) {
  std::vector<double> sum(4 * mesh.nodes());
  for (const Hex& hex : mesh.hexes) {
    std::array<double, 4> mean{0, 0, 0, 1};
    for (int n : hex)
      for (int c = 0; c < 3; ++c) mean[c] += (x[3 * n + c] - mesh.X[3 * n + c]) / 8;
    for (int n : hex)
      for (int c = 0; c < 4; ++c) sum[4 * n + c] += mean[c];
  }
  mesh.halo.accumulate_ghosts(sum, 4);
  std::vector<double> u(3 * mesh.nodes());
  for (int n = 0; n < mesh.owned; ++n)
    for (int c = 0; c < 3; ++c) u[3 * n + c] = sum[4 * n + c] / std::max(sum[4 * n + 3], 1.0);
  return u;
}

}  // namespace

void relax_inverted(const Problem& coarse, std::span<double> x) {
  const LocalMesh& mesh = coarse.mesh();
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto inverted = nodes_of_inverted(coarse, x);
    if (!coarse.comm().any(std::ranges::any_of(inverted, [](double n) { return n > 0; }))) return;
    const auto u = mean_displacements(mesh, x);
    for (int n = 0; n < mesh.owned; ++n)
      for (int c = 0; c < 3 && inverted[n] > 0; ++c) x[3 * n + c] = mesh.X[3 * n + c] + u[3 * n + c];
    mesh.halo.update_ghosts(x);
  }
}

}  // namespace bulbus::inline problem
