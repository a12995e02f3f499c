#pragma once
#include <fmt/format.h>

#include <functional>

#include "core/mesh/generate/embed.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/problem.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {

inline RegionSpec neo_hooke(double c10) {
  RegionSpec s;
  s.c10 = c10;
  return s;
}

inline RegionSpec rigid() {
  RegionSpec s;
  s.rigid = true;
  return s;
}

/// Hexahedra whose centre satisfies `inside` become a region of their own.
template <class Predicate>
void split_region(Mesh& mesh, const std::string& name, Predicate inside) {
  mesh.region_names.push_back(name);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    if (inside(center(mesh, static_cast<int>(h))))
      mesh.region[h] = static_cast<int>(mesh.region_names.size()) - 1;
}

/// Nodes for which `inside` holds.
template <class Predicate>
std::vector<int> nodes_where(const Mesh& mesh, Predicate inside) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (inside(mesh.points[n])) nodes.push_back(static_cast<int>(n));
  return nodes;
}

/// Appends another mesh; its regions and surfaces must have other names. Nodes are not joined.
inline void append(Mesh& mesh, const Mesh& other) {
  const int nodes = static_cast<int>(mesh.points.size()),
            regions = static_cast<int>(mesh.region_names.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (Hex h : other.hexes) {
    for (int& n : h) n += nodes;
    mesh.hexes.push_back(h);
  }
  for (int r : other.region) mesh.region.push_back(r + regions);
  mesh.region_names.insert(mesh.region_names.end(), other.region_names.begin(), other.region_names.end());
  for (const auto& [name, faces] : other.surfaces)
    for (Quad q : faces) {
      for (int& n : q) n += nodes;
      mesh.surfaces[name].push_back(q);
    }
}

namespace test {

/// A mesh and what is to happen to it: not the Scene of app/, which programs of tests link beside it.
struct Scene {
  Mesh mesh;
  Model model;
};

}  // namespace test

using test::Scene;

inline StepSpec step(std::string name, int increments = 1) {
  StepSpec s;
  s.name = std::move(name);
  s.increments = increments;
  return s;
}

inline DisplaceSpec displace(std::string set) {
  DisplaceSpec d;
  d.set = std::move(set);
  return d;
}

/// Block of n³ cells of size 1 in all, cut by the three symmetry planes, stretched in z by its face zmax.
inline Scene stretched_block(int n, const std::string& dz) {
  Scene scene{generate(BlockShape{.nx = n, .ny = n, .nz = n}), {}};
  scene.model.regions["block"] = neo_hooke(.5);
  scene.model.symmetry = {"x", "y", "z"};
  StepSpec s = step("stretch");
  DisplaceSpec d = displace("zmax");
  d.z = dz;
  s.displace.push_back(d);
  scene.model.steps.push_back(s);
  return scene;
}

/// A slab of cells `aspect` times as long as thick, both faces glued to plates that move by a fifth of its
/// thickness: sideways, or apart.
inline Scene glued_slab(double aspect, bool apart) {
  Scene scene{generate(BlockShape{.upper = {1, 1, 4 / (8 * aspect)}, .nx = 8, .ny = 8, .nz = 4}), {}};
  scene.model.regions["block"] = neo_hooke(.5);
  StepSpec s = step("pull", 2);
  DisplaceSpec low = displace("zmin"), high = displace("zmax");
  low.x = low.y = low.z = high.x = high.y = high.z = "0";
  (apart ? high.z : high.x) = fmt::format("{:.17g}", .1 / aspect);
  s.displace = {low, high};
  scene.model.steps = {s};
  return scene;
}

/// A liquid-filled shell with all that a coupled system can have: two tissues, a rigid cap at the z pole (cut
/// by x = 0 and, in an octant, by y = 0), bars with embedded ends, skew radial holds, given pressure in step
/// 0 and an enclosed liquid in step 1.
inline Scene filled_shell(const std::string& part) {
  Scene scene{generate(ShellShape{
                  .inner = 2, .outer = 2.6, .n = part == "octant" ? 3 : 2, .layers = 2, .part = part}),
              {}};
  Mesh& mesh = scene.mesh;
  split_region(mesh, "cap", [](const Point& p) { return p[2] > .86 * norm(p); });
  split_region(mesh, "belt", [](const Point& p) { return p[2] < .5 * norm(p); });
  mesh.node_sets["pulled"] = nodes_where(mesh, [](const Point& p) {
    return norm(p) > 2.59 && p[2] < 1.2 && p[2] > .1 && p[0] > .1 && p[1] > .1;
  });
  const auto& inner = mesh.surfaces.at("inner");
  mesh.bars["struts"] = {{{inner.front(), {.1, .2, .3, .4}}, {inner.back(), {.25, .25, .25, .25}}},
                         {at_node(inner[1][2]), {inner.back(), {0, .5, .5, 0}}, .5}};
  Model& m = scene.model;
  m.regions = {{"shell", neo_hooke(.5)}, {"cap", rigid()}, {"belt", neo_hooke(.3)}};
  m.regions["belt"].c01 = .2;
  m.regions["belt"].c20 = .1;
  m.bars["struts"].E = 20;
  m.bars["struts"].area = .05;
  m.liquids["fluid"] = {.surface = "inner", .K = 3};
  m.symmetry = part == "octant" ? std::vector<std::string>{"x", "y", "z"} : std::vector<std::string>{"x"};
  StepSpec fill = step("fill"), pull = step("pull");
  fill.pressures["fluid"] = "0.05";
  DisplaceSpec skew = displace("pulled");
  skew.radial = "0.05";
  skew.axis = {.1, -.2, 1};
  skew.center = {.3, -.1, 0};
  fill.displace.push_back(skew);
  pull.enclose = {"fluid"};
  pull.displace.push_back(skew);
  pull.displace[0].radial = "0.1";
  m.steps = {fill, pull};
  return scene;
}

/// One number per primal unknown, the same whatever the ranks.
inline std::vector<double> noise_primal(const Problem& problem, int seed) {
  const LocalMesh& mesh = problem.mesh();
  std::vector<double> q;
  for (int n = 0; n < mesh.owned; ++n)
    for (int c = 0; c < 3; ++c) q.push_back(noise(seed, 3 * mesh.input_node[n] + c));
  for (int i = 0; i < problem.dofs().tail_size(); ++i) q.push_back(noise(seed + 1, i));
  return q;
}

inline std::vector<double> noise_lambda(const Problem& problem, int seed) {
  std::vector<double> v;
  for (int h : problem.mesh().input_hex) v.push_back(noise(seed + 2, h));
  return v;
}

/// `state` moved by step · q along the free directions.
inline State moved(const Problem& problem, const State& state, std::span<const double> q, double step) {
  State s = state;
  std::vector<double> dx(s.x.size());
  problem.dofs().expand(state, q, dx);
  problem.dofs().move(s, dx, q, step);
  return s;
}

/// A random admissible state: nodes shaken along the free directions, random pressures.
inline State shaken(const Problem& problem, const State& from, double shake, int seed) {
  State s = moved(problem, from, noise_primal(problem, seed), shake);
  const auto lambda = noise_lambda(problem, seed);
  for (std::size_t e = 0; e < lambda.size(); ++e) s.lambda[e] += .2 * lambda[e];
  return s;
}

inline std::vector<double> reduced(const Problem& problem, const State& state,
                                   std::span<const double> force) {
  std::vector<double> r(problem.dofs().primal_size());
  problem.dofs().reduce(state, force, r);
  return r;
}

}  // namespace bulbus
