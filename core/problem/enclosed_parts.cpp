#include "core/problem/enclosed_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/problem/connected_parts.hpp"
#include "core/problem/formula.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double rounding = 1e-9;         // of Σ ∂V_e/∂x on free directions, relative to all of it
constexpr double least_flux = 1e-7;       // of a part's volume: less than Newton's criterion sees
constexpr double compressibility = 1e-9;  // of volume and shear modulus

// Σ_e ∂V_e/∂x on every local node, accumulated: by what λ = 1 MPa adds to the internal forces.
std::vector<double> volume_gradient(const Problem& problem, const State& at) {
  const Solid& solid = problem.solid();
  std::vector<double> with(at.x.size()), without(at.x.size()), volume_error(solid.hexes()),
      lambda(solid.hexes());
  solid.residual(at.x, lambda, without, volume_error);
  std::ranges::fill(lambda, 1.0);
  solid.residual(at.x, lambda, with, volume_error);
  for (std::size_t i = 0; i < with.size(); ++i) with[i] -= without[i];
  problem.mesh().halo.accumulate_ghosts(with);
  return with;
}

// ‖free part of g‖² and ‖g‖² of every part.
std::vector<double> squares(const Problem& problem, const State& at, const ConnectedParts& parts,
                            const std::vector<double>& g) {
  const std::size_t count = parts.count;
  std::vector<double> sums(2 * count), free(g);
  problem.dofs().project(free);
  for (int n = 0; n < problem.mesh().owned; ++n)
    if (const int p = parts.of_node[n]; p >= 0)
      for (int i = 3 * n; i < 3 * n + 3; ++i) sums[p] += free[i] * free[i], sums[count + p] += g[i] * g[i];
  problem.comm().sum(sums);
  const auto bodies = problem.dofs().reduce_bodies(at, g);
  for (std::size_t b = 0; b < problem.dofs().bodies().size(); ++b) {
    double part = -1;
    for (int n : problem.dofs().bodies()[b].nodes())
      part = std::max(part, static_cast<double>(parts.of_node[n]));
    part = problem.comm().max(part);
    for (int i = 0; i < 6 && part >= 0; ++i)
      sums[static_cast<int>(part)] += bodies[6 * b + i] * bodies[6 * b + i];
  }
  return sums;
}

std::vector<double> volumes(const Problem& problem, std::span<const double> x, std::span<const int> part,
                            std::size_t count) {
  const Solid& solid = problem.solid();
  std::vector<double> force(x.size()), volume_error(solid.hexes()), lambda(solid.hexes()), sums(count);
  solid.residual(x, lambda, force, volume_error);
  for (int h = 0; h < solid.hexes(); ++h)
    if (part[h] >= 0) sums[part[h]] += solid.reference_volumes()[h] + volume_error[h];
  problem.comm().sum(sums);
  return sums;
}

}  // namespace

EnclosedParts::EnclosedParts(const Problem& problem, const State& start, int step) : problem_(&problem) {
  const ConnectedParts parts = connected_parts(problem.mesh(), problem.solid().regions());
  const auto sums = squares(problem, start, parts, volume_gradient(problem, start));
  std::vector<int> number(parts.count, -1);
  for (int p = 0; p < parts.count; ++p)
    if (sums[parts.count + p] > 0 && sums[p] <= rounding * rounding * sums[parts.count + p]) {
      number[p] = static_cast<int>(names_.size());
      names_.push_back(parts.names[p]);
    }
  if (!any()) return;
  const Solid& solid = problem.solid();
  part_.assign(solid.hexes(), -1);
  compliance_.assign(solid.hexes(), 0);
  for (const SolidRegion& r : solid.regions())
    for (int h = r.first; h < r.first + r.count; ++h) {
      part_[h] = number[parts.of_node[problem.mesh().hexes[h][0]]];
      compliance_[h] = compressibility * solid.reference_volumes()[h] / initial_shear_modulus(r.material);
    }
  const std::size_t count = names_.size();
  volume_.assign(count, 0);
  for (int h = 0; h < solid.hexes(); ++h)
    if (part_[h] >= 0) volume_[part_[h]] += solid.reference_volumes()[h];
  problem.comm().sum(volume_);
  mean_ = means(start.lambda);
  std::vector<double> prescribed(start.x.size()), x;
  for (double s : looked_at) {
    problem.dofs().prescribed_increment(start, s, prescribed);
    x = start.x;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += prescribed[i];
    const auto room = volumes(problem, x, part_, count);
    for (std::size_t p = 0; p < count; ++p)
      if (const double gap = room[p] - volume_[p]; std::abs(gap) > least_flux * volume_[p])
        throw scene_error(
            "steps." + std::to_string(step),
            fmt::format("no solution: the constraints prescribe the whole surface of {}, which is "
                        "incompressible, and leave it {:.6g} mm3 "
                        "for its {:.6g} mm3: {:.4g} mm3 {}",
                        names_[p], room[p], volume_[p], std::abs(gap),
                        gap < 0 ? "have no place" : "are missing"),
            "Leave a part of its surface free to give way, or prescribe motions that keep its volume.");
  }
}

std::vector<std::string> EnclosedParts::sentences() const {
  std::vector<std::string> sentences;
  for (const std::string& name : names_)
    sentences.push_back("the constraints fix the volume of " + name +
                        ", which is incompressible: its pressure, and with it every reaction, is determined "
                        "up to one number. Its mean "
                        "pressure is kept as it was (0 at first); leave a part of its surface free for a "
                        "pressure that means something");
  return sentences;
}

std::vector<double> EnclosedParts::means(std::span<const double> lambda) const {
  std::vector<double> sums(names_.size());
  const auto V0 = problem_->solid().reference_volumes();
  for (std::size_t h = 0; h < part_.size(); ++h)
    if (part_[h] >= 0) sums[part_[h]] += V0[h] * lambda[h] / volume_[part_[h]];
  problem_->comm().sum(sums);
  return sums;
}

void EnclosedParts::settle(std::span<double> lambda) const {
  if (!any()) return;
  const auto now = means(lambda);
  for (std::size_t h = 0; h < part_.size(); ++h)
    if (part_[h] >= 0) lambda[h] += mean_[part_[h]] - now[part_[h]];
}

}  // namespace bulbus::inline problem
