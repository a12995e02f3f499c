#include "core/problem/bars_on_planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/generate/embed.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline problem {
namespace {

// Of a bar and its images, how many lie where it lies: 2 for each plane that it lies in.
int in_one_place(const Mesh& mesh, const Model& model, const Bar& bar, double tolerance) {
  const Point a = position(mesh, bar.a), b = position(mesh, bar.b);
  int count = 1;
  for (const std::string& plane : model.symmetry)
    if (const int c = axis_of(plane); std::abs(a[c]) <= tolerance && std::abs(b[c]) <= tolerance) count *= 2;
  return count;
}

}  // namespace

std::vector<std::string> bars_on_planes(const Mesh& mesh, const Model& model) {
  std::vector<std::string> sentences;
  const double tolerance = mesh_tolerance(mesh);
  for (const auto& [name, group] : mesh.bars) {
    const auto count = std::ranges::count_if(group, [&](const Bar& bar) {
      const int images = in_one_place(mesh, model, bar, tolerance);
      return images > 1 && bar.share * images > 1 + 1e-6;  // a share of 1/2 or 1/4 is exact, others are typed
    });
    if (count > 0)
      sentences.push_back(fmt::format(
          "{} of {} bars '{}' lie in a plane of symmetry, where the drawn part and its image both "
          "have them: the whole is too stiff there. Put them into a group '{} share=0.5', or "
          "'{} share=0.25' where two planes meet",
          count, group.size(), name, name, name));
  }
  return sentences;
}

}  // namespace bulbus::inline problem
