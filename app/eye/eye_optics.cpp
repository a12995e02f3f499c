#include "app/eye/eye_optics.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/eye/corneal_fit.hpp"
#include "core/base/error.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline eye {
namespace {

constexpr double keratometric = 337.5;  // D mm: index 1.3375, the keratometers' convention
constexpr double aqueous = 1336;        // D mm: index 1.336 of aqueous and vitreous

using Figure = ProbeSet::Figure;

// Owned nodes within the zone on the undeformed eye.
std::vector<int> nodes_in_zone(const Problem& problem, const ProbeSpec& spec) {
  auto nodes = probes::owned_nodes(problem, spec.set);
  std::erase_if(nodes, [&](int n) {
    const Vec3<double> X = at(problem.mesh().X, n);
    return std::hypot(X[0], X[1]) > spec.zone / 2;
  });
  const int found = problem.comm().sum(static_cast<int>(nodes.size()));
  if (found * problem.multiplicity() < 2 * CornealSums::unknowns)
    throw scene_error("zone",
                      fmt::format("only {} nodes of '{}' lie within {:g} mm about the z axis: too few to "
                                  "measure a curvature",
                                  found, spec.set, spec.zone),
                      "Give a wider zone, or a finer mesh.");
  return nodes;
}

// The point and its images in the planes of symmetry; one that lies on a plane is its own image.
void add_with_images(const Problem& problem, const Vec3<double>& x, std::size_t planes, CornealSums& sums) {
  if (planes == 0) return sums.add(x);
  const int c = axis_of(problem.model().symmetry[planes - 1]);
  add_with_images(problem, x, planes - 1, sums);
  if (std::abs(x[c]) <= 1e-9 * norm(x)) return;
  Vec3<double> image = x;
  image[c] = -x[c];
  add_with_images(problem, image, planes - 1, sums);
}

CornealVertex vertex_of(Snapshot& s, std::span<const int> nodes) {
  CornealSums sums;
  for (int n : nodes) add_with_images(s.problem, at(s.state.x, n), s.problem.model().symmetry.size(), sums);
  s.problem.comm().sum(sums.v);
  return fitted_cornea(sums);
}

double mean_power(const CornealVertex& v) { return keratometric * (v.steep + v.flat) / 2; }

template <class Number>
auto of_cornea(Number number) {
  return [number](const Problem& problem, const ProbeSpec& spec) -> Figure {
    return
        [nodes = nodes_in_zone(problem, spec), number](Snapshot& s) { return number(vertex_of(s, nodes)); };
  };
}

double mean_height(Snapshot& s, std::span<const int> nodes) {
  std::vector<double> heights;
  for (int n : nodes) heights.push_back(s.state.x[3 * n + 2]);
  return probes::statistic(s.problem.comm(), "mean", heights);
}

Figure refraction_of(const Problem& problem, const ProbeSpec& spec) {
  return [cornea = nodes_in_zone(problem, spec), retina = probes::owned_nodes(problem, spec.to),
          lens = probes::owned_nodes(problem, spec.region), power = spec.lens_power](Snapshot& s) {
    const CornealVertex v = vertex_of(s, cornea);
    return refraction(mean_power(v), power, v.z - mean_height(s, lens), v.z - mean_height(s, retina));
  };
}

}  // namespace

double refraction(double corneal_power, double lens_power, double lens_depth, double length) {
  const double at_lens = aqueous / (length - lens_depth) - lens_power;
  return aqueous / (lens_depth + aqueous / at_lens) - corneal_power;
}

ProbeSet::Kinds optical_probes() {
  using Q = Quantity;
  ProbeSet::Kinds kinds;
  kinds["corneal_power"] = {Q::number, of_cornea(mean_power), "D"};
  kinds["corneal_astigmatism"] = {
      Q::number, of_cornea([](const CornealVertex& v) { return keratometric * (v.steep - v.flat); }), "D"};
  kinds["steep_meridian"] = {Q::angle, of_cornea([](const CornealVertex& v) { return v.meridian; })};
  kinds["refraction"] = {Q::number, refraction_of, "D"};
  return kinds;
}

}  // namespace bulbus::inline eye
