#include "precond/amg/assembled.hpp"

#include <cmath>

#include "core/solve/assemble.hpp"

namespace bulbus::inline precond {
namespace {

// Of strong connections: each takes the least time of .25, .5, .7 and .9
// (benchmarks/notebook/displacement_block.md).
constexpr double unknown_threshold = .9, nodal_threshold = .25;

// Triplets come sorted, each entry once.
DistributedCsr to_rows(const Triplets& t, long long first_row, int rows) {
  DistributedCsr m{first_row, rows, {}, {}, {t.col.begin(), t.col.end()}, t.value};
  for (std::size_t k = 0; k < t.row.size(); ++k)
    if (k == 0 || t.row[k] != t.row[k - 1]) {
      m.row_ids.push_back(t.row[k]);
      m.start.push_back(static_cast<int>(k));
    }
  m.start.push_back(static_cast<int>(t.row.size()));
  return m;
}

// Rotations in the current configuration about the middle of the nodes, of the size of a unit translation,
// zero in constrained directions.
std::vector<std::vector<double>> rotations(const CoupledSystem& system) {
  const Problem& problem = system.problem();
  const auto& x = system.state().x;
  std::array<double, 5> sum{};  // x, y, z, their squares, nodes
  for (int n = 0; n < problem.mesh().owned; ++n) {
    for (int c = 0; c < 3; ++c) sum[c] += x[3 * n + c], sum[3] += x[3 * n + c] * x[3 * n + c];
    ++sum[4];
  }
  problem.comm().sum(sum);
  const Vec3<double> middle{sum[0] / sum[4], sum[1] / sum[4], sum[2] / sum[4]};
  const double radius = std::sqrt(sum[3] / sum[4] - dot(middle, middle));
  std::vector<std::vector<double>> modes(3, std::vector<double>(x.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    for (std::size_t n = 0; n < x.size() / 3; ++n) {
      modes[axis][3 * n + i] = -(x[3 * n + j] - middle[j]) / radius;
      modes[axis][3 * n + j] = (x[3 * n + i] - middle[i]) / radius;
    }
    problem.dofs().project(modes[axis]);
    modes[axis].resize(system.layout().nodal);
  }
  return modes;
}

}  // namespace

AssembledAmg::AssembledAmg(const CoupledSystem& system, bool nodal)
    : nodal_(system.layout().nodal), jacobi_(system) {
  AmgOptions options;
  options.functions = 3;
  options.nodal = nodal;
  options.threshold = nodal ? nodal_threshold : unknown_threshold;
  if (nodal) options.rigid_modes = rotations(system);
  amg_ = std::make_unique<BoomerAmg>(
      to_rows(assemble_displacement(system), 3 * system.problem().mesh().first_node, nodal_), options,
      system.problem().comm());
}

void AssembledAmg::apply(std::span<const double> x, std::span<double> y) const {
  jacobi_.apply(x, y);
  amg_->apply(x.first(nodal_), y.first(nodal_));
}

ExactBlock::ExactBlock(const CoupledSystem& system)
    : ExactBlock(system, std::make_shared<Mumps>(system.problem().comm())) {}

ExactBlock::ExactBlock(const CoupledSystem& system, std::shared_ptr<Mumps> mumps, const KeepFactors& keep)
    : size_(system.layout().primal()),
      nodal_(system.layout().nodal),
      bodies_(system),
      mumps_(std::move(mumps)) {
  const bool symmetric = system.problem().symmetric();
  const FactorReport f =
      mumps_->factorise(assemble_displacement(system, symmetric ? Triangles::upper : Triangles::both),
                        3 * system.problem().mesh().all_nodes, symmetric, keep);
  keeps_factors_ = f.kept;
  if (!f.ok) setup_error_ = "displacement block: " + f.reason;
  bytes_ = static_cast<std::size_t>(f.memory_max_mb * 1e6);
}

void ExactBlock::apply(std::span<const double> x, std::span<double> y) const {
  bodies_.apply(x.subspan(nodal_), y.subspan(nodal_));
  mumps_->solve(x.first(nodal_), y.first(nodal_));
}

}  // namespace bulbus::inline precond
