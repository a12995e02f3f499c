#include "core/solve/near_null_space.hpp"

namespace bulbus::inline solve {
namespace {

constexpr int rigid_motions = 6;

// Of rigid bodies, the same on every rank: each rank that has one of a body's nodes knows it.
std::vector<Vec3<double>> body_centers(const CoupledSystem& system) {
  const State& state = system.state();
  const auto bodies = system.problem().dofs().bodies();
  std::vector<double> sums(4 * bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].nodes().empty()) continue;
    const int node = bodies[b].nodes()[0];
    const Vec3<double> x = at(state.x, node), arm = bodies[b].arm(state.bodies[b], state.x, node);
    for (int c = 0; c < 3; ++c) sums[4 * b + c] = x[c] - arm[c];
    sums[4 * b + 3] = 1;
  }
  system.problem().comm().sum(sums);
  std::vector<Vec3<double>> centers(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int c = 0; c < 3; ++c) centers[b][c] = sums[4 * b + c] / sums[4 * b + 3];
  return centers;
}

Vec3<double> axis_vector(int c) {
  Vec3<double> e{0, 0, 0};
  e[c] = 1;
  return e;
}

Vec3<double> displacement(int mode, const Vec3<double>& x) {
  return mode < 3 ? axis_vector(mode) : cross(axis_vector(mode - 3), x);
}

}  // namespace

std::vector<double> unknown_coordinates(const CoupledSystem& system) {
  const Layout& layout = system.layout();
  const LocalMesh& mesh = system.problem().mesh();
  const auto centers = body_centers(system);
  std::vector<double> coordinates(3 * layout.size());
  const auto put = [&](int unknown, const Vec3<double>& x) {
    for (int c = 0; c < 3; ++c) coordinates[3 * unknown + c] = x[c];
  };
  for (int i = 0; i < layout.nodal; ++i) put(i, at(system.state().x, i / 3));
  for (int i = 0; i < layout.bodies; ++i) put(layout.nodal + i, centers[i / 6]);
  for (int h = 0; h < layout.hexes; ++h) {
    Vec3<double> middle{0, 0, 0};
    for (int n : mesh.hexes[h])
      for (int c = 0; c < 3; ++c) middle[c] += system.state().x[3 * n + c] / 8;
    put(layout.primal() + h, middle);
  }
  return coordinates;
}

std::vector<double> near_null_space(const CoupledSystem& system) {
  const Layout& layout = system.layout();
  const DofMap& dofs = system.problem().dofs();
  const auto centers = body_centers(system);
  std::vector<double> space(rigid_motions * layout.size());
  for (int mode = 0; mode < rigid_motions; ++mode) {
    std::vector<double> nodal(layout.nodal);
    for (int n = 0; n < layout.nodal / 3; ++n) {
      const Vec3<double> u = displacement(mode, at(system.state().x, n));
      for (int c = 0; c < 3; ++c) nodal[3 * n + c] = u[c];
    }
    dofs.project(nodal);
    for (int i = 0; i < layout.nodal; ++i) space[rigid_motions * i + mode] = nodal[i];
    for (int i = 0; i < layout.bodies; ++i) {
      if (!dofs.bodies()[i / 6].free()[i % 6]) continue;
      const Vec3<double> shift = displacement(mode, centers[i / 6]);
      space[rigid_motions * (layout.nodal + i) + mode] = i % 6 < 3 ? shift[i % 6] : (mode == i % 6 ? 1 : 0);
    }
  }
  return space;
}

}  // namespace bulbus::inline solve
