#pragma once
#include "tests/extremes/run.hpp"

namespace bulbus {

/// A neo-Hookean layer of a sphere, from `inner` to `outer`, mm.
struct ShellLayer {
  double inner, outer, c10;
};

/// Pressure in a sphere of incompressible neo-Hookean layers whose inside has the stretch `la`: Σ c10 [4/l +
/// 1/l⁴] from inside to outside.
inline double pressure_of(const std::vector<ShellLayer>& layers, double la) {
  const double a = layers.front().inner;
  const auto stretch = [&](double R) { return std::cbrt(1 + (la * la * la - 1) * std::pow(a / R, 3)); };
  const auto h = [&](double R) { return 4 / stretch(R) + 1 / std::pow(stretch(R), 4); };
  double p = 0;
  for (const ShellLayer& l : layers) p += l.c10 * (h(l.outer) - h(l.inner));
  return p;
}

/// An octant of a liquid-filled shell of layers, each of `cells` cells, in `increments` filled by beta times
/// its volume.
inline Scene filled_layers(int n, int cells, const std::vector<ShellLayer>& layers, double beta, double K,
                           int increments) {
  const double inner = layers.front().inner, outer = layers.back().outer;
  const int count = static_cast<int>(layers.size()), all = cells * count;
  Scene scene{generate(ShellShape{.inner = inner, .outer = outer, .n = n, .layers = all}), {}};
  for (Point& p : scene.mesh.points) {  // equal layers to those asked for
    const double r = norm(p), at = (r - inner) / (outer - inner) * count;
    const int k = std::clamp(static_cast<int>(at + 1e-6), 0, count - 1);
    const double to = layers[k].inner + (at - k) * (layers[k].outer - layers[k].inner);
    for (double& c : p) c *= to / r;
  }
  Model& m = scene.model;
  m.regions["shell"] = neo_hooke(layers.front().c10);
  for (int k = 1; k < count; ++k) {
    const std::string name = fmt::format("layer {}", k);
    split_region(scene.mesh, name,
                 [&, least = layers[k].inner](const Point& p) { return norm(p) > least * (1 - 1e-9); });
    m.regions[name] = neo_hooke(layers[k].c10);
  }
  m.liquids["fluid"] = {.surface = "inner", .K = K};
  m.symmetry = {"x", "y", "z"};
  StepSpec s = step("fill", increments);
  s.enclose = {"fluid"};
  m.steps = {s};
  const Problem still(scene.mesh, m, Comm(MPI_COMM_SELF));
  m.steps[0].add["fluid"] = beta * still.multiplicity() * still.liquids()[0].volume(still.mesh().X);
  return scene;
}

/// Stretch of the inside by the volume of its liquid.
inline double stretch_of(const Trial& run) {
  const auto& liquid = run.problem.liquids()[0];
  return std::cbrt(liquid.volume(run.state.x) / liquid.volume(run.problem.mesh().X));
}

}  // namespace bulbus
