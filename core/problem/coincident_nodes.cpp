#include "core/problem/coincident_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "core/base/sort_unique.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/hex_edges.hpp"
#include "core/problem/contact_nodes.hpp"

namespace bulbus::inline problem {
namespace {

using Pair = std::pair<int, int>;  // two nodes, the lower first

constexpr double of_edge = .01;      // of the shortest: no cell lies between nodes so near
constexpr double least_cell = 1e-6;  // of the mesh's diagonal: 2²⁰ cells fit into 21 bits per axis

double shortest_edge(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const Hex& h : mesh.hexes)
    for (const auto& [i, j] : hex_edges) {
      const Point d = mesh.points[h[i]] - mesh.points[h[j]];
      least = std::min(least, dot(d, d));
    }
  return std::sqrt(least);
}

// A node in a cell of a grid; one that is nearer than the tolerance to the cell's side is in the next cell
// too.
struct Entry {
  std::uint64_t cell;
  int node;
};

class Grid {
 public:
  Grid(const Mesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance), low_(mesh.points.front()) {
    for (const Point& p : mesh.points)
      for (int c = 0; c < 3; ++c) low_[c] = std::min(low_[c], p[c]);
    cell_ = std::max(tolerance / of_edge / 2, least_cell * diagonal(mesh));
    entries_.reserve(mesh.points.size() + mesh.points.size() / 8);
    for (std::size_t n = 0; n < mesh.points.size(); ++n) insert(static_cast<int>(n));
    std::ranges::sort(entries_, {}, [](const Entry& e) { return std::pair(e.cell, e.node); });
  }

  std::vector<Pair> pairs() const {
    std::vector<Pair> found;
    for (std::size_t i = 0; i < entries_.size(); ++i)
      for (std::size_t j = i + 1; j < entries_.size() && entries_[j].cell == entries_[i].cell; ++j)
        if (norm(mesh_.points[entries_[i].node] - mesh_.points[entries_[j].node]) <= tolerance_)
          found.emplace_back(entries_[i].node, entries_[j].node);
    sort_unique(found);
    return found;
  }

 private:
  void insert(int n) {
    std::array<std::uint64_t, 3> first, last;
    for (int c = 0; c < 3; ++c) {
      const double x = mesh_.points[n][c] - low_[c];
      first[c] = static_cast<std::uint64_t>(std::max(0.0, (x - tolerance_) / cell_));
      last[c] = static_cast<std::uint64_t>((x + tolerance_) / cell_);
    }
    for (auto i = first[0]; i <= last[0]; ++i)
      for (auto j = first[1]; j <= last[1]; ++j)
        for (auto k = first[2]; k <= last[2]; ++k) entries_.push_back({(i << 42) + (j << 21) + k, n});
  }

  const Mesh& mesh_;
  double tolerance_, cell_;
  Point low_;
  std::vector<Entry> entries_;
};

// The first region whose hexahedra have the node; −1 for ends of bars.
std::vector<int> regions_of_nodes(const Mesh& mesh) {
  std::vector<int> region(mesh.points.size(), -1);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h])
      if (region[n] < 0) region[n] = mesh.region[h];
  return region;
}

std::string sentence(const Mesh& mesh, const Pair& regions, const std::vector<int>& nodes) {
  const std::string &a = mesh.region_names[regions.first], &b = mesh.region_names[regions.second];
  const Point& p = mesh.points[nodes.front()];
  return fmt::format(
      "{} nodes of region '{}' stand where {} stand, without being joined to them, first at ({:.4g}, {:.4g}, "
      "{:.4g}) mm: the bodies "
      "part there. Merge the nodes (in Gmsh: Coherence, or Coherence Mesh), or describe a contact between "
      "the two surfaces.",
      nodes.size(), a, a == b ? "other nodes of it" : "nodes of region '" + b + "'", p[0], p[1], p[2]);
}

}  // namespace

std::vector<std::string> coincident_nodes(const Mesh& mesh, const Model& model) {
  auto pairs = Grid(mesh, of_edge * shortest_edge(mesh)).pairs();
  if (pairs.empty()) return {};
  const ContactNodes contacts(mesh, model);
  std::erase_if(pairs, [&](const Pair& p) { return contacts.join(p.first, {&p.second, 1}); });
  const auto region = regions_of_nodes(mesh);
  std::map<Pair, std::vector<int>> nodes;
  for (const auto& [a, b] : pairs)
    if (region[a] >= 0 && region[b] >= 0) nodes[std::minmax(region[a], region[b])].push_back(a);
  std::vector<std::string> warnings;
  for (const auto& [regions, found] : nodes) warnings.push_back(sentence(mesh, regions, found));
  return warnings;
}

}  // namespace bulbus::inline problem
