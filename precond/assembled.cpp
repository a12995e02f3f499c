#include "precond/assembled.hpp"

#include <algorithm>
#include <numeric>

#include "core/solve/assemble.hpp"

namespace bulbus {
namespace {

DistributedCsr to_rows(const Triplets& t, long long first_row, int rows) {
  DistributedCsr m{first_row, rows, {}, {}, {}, {}};
  std::vector<std::size_t> order(t.row.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return std::pair(t.row[a], t.col[a]) < std::pair(t.row[b], t.col[b]); });
  for (std::size_t i : order) {
    const bool new_row = m.row_ids.empty() || m.row_ids.back() != t.row[i];
    if (new_row) {
      m.row_ids.push_back(t.row[i]);
      m.start.push_back(static_cast<int>(m.values.size()));
    }
    if (!new_row && m.columns.back() == t.col[i]) {
      m.values.back() += t.value[i];
      continue;
    }
    m.columns.push_back(t.col[i]);
    m.values.push_back(t.value[i]);
  }
  m.start.push_back(static_cast<int>(m.values.size()));
  return m;
}

// Rotations about the axes in the current configuration, zero in held directions.
std::vector<std::vector<double>> rotations(const CoupledSystem& system) {
  const Problem& problem = system.problem();
  const auto& x = system.state().x;
  std::vector<std::vector<double>> modes(3, std::vector<double>(x.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (std::size_t n = 0; n < x.size() / 3; ++n) {
      modes[axis][3 * n + i] = -x[3 * n + j];
      modes[axis][3 * n + j] = x[3 * n + i];
    }
    problem.dofs().project(modes[axis]);
    modes[axis].resize(system.layout().nodal);
  }
  return modes;
}

}  // namespace

AssembledAmg::AssembledAmg(const CoupledSystem& system, bool nodal) : nodal_(system.layout().nodal), jacobi_(system) {
  AmgOptions options;
  options.functions = 3;
  options.nodal = nodal;
  if (nodal) options.rigid_modes = rotations(system);
  amg_ = std::make_unique<BoomerAmg>(to_rows(assemble_displacement(system), 3 * system.problem().mesh().first_node, nodal_), options,
                                     system.problem().comm());
}

void AssembledAmg::apply(std::span<const double> x, std::span<double> y) const {
  jacobi_.apply(x, y);
  amg_->apply(x.first(nodal_), y.first(nodal_));
}

ExactBlock::ExactBlock(const CoupledSystem& system)
    : nodal_(system.layout().nodal), jacobi_(system), mumps_(std::make_unique<Mumps>(system.problem().comm())) {
  const FactorReport f = mumps_->factorise(assemble_displacement(system), 3 * system.problem().mesh().all_nodes, system.problem().symmetric());
  bytes_ = static_cast<std::size_t>(f.memory_max_mb * 1e6);
}

void ExactBlock::apply(std::span<const double> x, std::span<double> y) const {
  jacobi_.apply(x, y);
  mumps_->solve(x.first(nodal_), y.first(nodal_));
}

}  // namespace bulbus
