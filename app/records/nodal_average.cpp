#include "app/records/nodal_average.hpp"

namespace bulbus::inline app {
namespace {

// Per node: volume × value of its cells, then the volumes.
std::vector<double> sums_of_cells(const Problem& problem, std::span<const double> values, int width) {
  const LocalMesh& mesh = problem.mesh();
  const auto V0 = problem.solid().reference_volumes();
  std::vector<double> sums(static_cast<std::size_t>(mesh.nodes()) * (width + 1));
  for (const SolidRegion& r : problem.solid().regions())
    for (int h = r.first; h < r.first + r.count; ++h)
      for (int n : mesh.hexes[h]) {
        double* sum = &sums[static_cast<std::size_t>(n) * (width + 1)];
        for (int c = 0; c < width; ++c) sum[c] += V0[h] * values[static_cast<std::size_t>(h) * width + c];
        sum[width] += V0[h];
      }
  return sums;
}

}  // namespace

std::vector<double> nodal_average(const Problem& problem, std::span<const double> cell_values, int width) {
  std::vector<double> sums = sums_of_cells(problem, cell_values, width);
  problem.mesh().halo.accumulate_ghosts(sums, width + 1);
  problem.mesh().halo.update_ghosts(sums, width + 1);
  std::vector<double> average;
  for (std::size_t at = 0; at < sums.size(); at += width + 1)
    for (int c = 0; c < width; ++c)
      average.push_back(sums[at + width] > 0 ? sums[at + c] / sums[at + width] : 0);
  return average;
}

}  // namespace bulbus::inline app
