#include "core/problem/thickened_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/mesh/faces.hpp"

namespace bulbus::inline problem {

namespace {

// Hexahedra all of whose nodes are among these.
std::ptrdiff_t filled(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<char> in(mesh.points.size());
  for (int n : nodes) in[n] = 1;
  return std::ranges::count_if(
      mesh.hexes, [&](const Hex& h) { return std::ranges::all_of(h, [&](int n) { return in[n]; }); });
}

}  // namespace

std::vector<std::string> thickened_sets(const Mesh& mesh, const Model& model) {
  std::set<std::string> held;
  for (const FixSpec& fix : model.fix) held.insert(fix.set);
  for (const StepSpec& step : model.steps)
    for (const DisplaceSpec& displace : step.displace) held.insert(displace.set);
  std::vector<std::string> sentences;
  for (const std::string& name : held) {
    const auto found = mesh.node_sets.find(name);
    if (found == mesh.node_sets.end()) continue;  // faces of a surface have no inside, a region is meant so
    if (const auto count = filled(mesh, found->second); count > 0)
      sentences.push_back(
          fmt::format("set '{}' has all eight nodes of {} hexahedra: `mesh.refine` gives it the nodes inside "
                      "of them too, and "
                      "these are held as well. Where faces are meant, give each side of the layer a set of "
                      "its own, or name a "
                      "surface",
                      name, count));
  }
  return sentences;
}

std::vector<std::string> thickened_surfaces(const Mesh& mesh, const std::vector<std::string>& names) {
  std::vector<std::string> sentences;
  for (const std::string& name : names)
    if (const auto count = filled(mesh, nodes_of_faces(mesh.surfaces.at(name))); count > 0)
      sentences.push_back(
          fmt::format("surface '{}' has all eight nodes of {} hexahedra, so that faces at their sides belong "
                      "to it as well: "
                      "its condition holds at more than one layer of nodes. Choose a narrower one, or give "
                      "each side of a "
                      "sheet a surface of its own",
                      name, count));
  return sentences;
}

}  // namespace bulbus::inline problem
