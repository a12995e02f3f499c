#include "precond/amg/scalar_matrices.hpp"

#include <algorithm>

#include "core/solve/reduced.hpp"

namespace bulbus::inline precond {
namespace {

// Sorted neighbours of every local node, itself included, as the contributions couple them.
struct Pattern {
  std::vector<int> start, columns;
  std::size_t at(int row, int column) const {
    const auto first = columns.begin() + start[row], last = columns.begin() + start[row + 1];
    return std::lower_bound(first, last, column) - columns.begin();
  }
};

Pattern find_pattern(const CoupledSystem& system) {
  const Problem& problem = system.problem();
  const LocalMesh& mesh = problem.mesh();
  std::vector<std::vector<int>> rows(mesh.nodes());
  const auto couple = [&](std::span<const int> nodes) {
    for (int a : nodes) rows[a].insert(rows[a].end(), nodes.begin(), nodes.end());
  };
  for (const SolidRegion& r : problem.solid().regions())
    for (int h = r.first; h < r.first + r.count; ++h) couple(mesh.hexes[h]);
  for (const auto& tangent : system.tangents().terms)
    if (tangent) tangent->visit([&](std::span<const int> nodes, std::span<const double>) { couple(nodes); });
  Pattern p{{0}, {}};
  for (int n = 0; n < mesh.nodes(); ++n) {
    auto& row = rows[n];
    row.push_back(n);
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    p.columns.insert(p.columns.end(), row.begin(), row.end());
    p.start.push_back(static_cast<int>(p.columns.size()));
    std::vector<int>().swap(row);
  }
  return p;
}

}  // namespace

std::array<DistributedCsr, 3> scalar_matrices(const CoupledSystem& system) {
  const LocalMesh& mesh = system.problem().mesh();
  const Pattern pattern = find_pattern(system);
  std::array<DistributedCsr, 3> m;
  m[0] = {mesh.first_node, mesh.owned, mesh.number, pattern.start, {}, {}};
  for (int column : pattern.columns) m[0].columns.push_back(mesh.number[column]);
  m[1] = m[2] = m[0];
  for (auto& matrix : m) matrix.values.assign(pattern.columns.size(), 0);
  const int nodal = 3 * mesh.nodes();
  std::vector<std::size_t> firsts;
  for_each_condensed_matrix(system, Matrices::augmented,
                            [&](std::span<const int> d, std::span<const double> K) {
                              const std::size_t n = d.size();
                              first_of_nodes(d, nodal, firsts);
                              for (const std::size_t i : firsts)
                                for (const std::size_t j : firsts) {
                                  const std::size_t at = pattern.at(d[i] / 3, d[j] / 3);
                                  for (int c = 0; c < 3; ++c) m[c].values[at] += K[(i + c) * n + j + c];
                                }
                            });
  const DofMap& dofs = system.problem().dofs();
  for (int n = 0; n < mesh.owned; ++n)
    if (dofs.constrained(n)) {
      const Mat3<double> P = dofs.projector(n);
      for (int c = 0; c < 3; ++c)
        m[c].values[pattern.at(n, n)] += system.constrained_diagonal() * (1 - P(c, c));
    }
  return m;
}

}  // namespace bulbus::inline precond
