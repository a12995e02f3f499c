#include "core/mesh/distributed/mesh_part.hpp"

#include <algorithm>
#include <numeric>

#include "core/mesh/faces.hpp"

namespace bulbus::inline mesh {
namespace {

using Marks = std::vector<bool>;

template <class Nodes>
bool all_in(const Nodes& nodes, const Marks& in) {
  return std::ranges::all_of(nodes, [&](int n) { return in[n]; });
}

template <class Nodes>
Nodes translated(Nodes nodes, const std::vector<int>& to) {
  for (int& n : nodes) n = to[n];
  return nodes;
}

std::vector<int> marked(const Marks& marks) {
  std::vector<int> found;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) found.push_back(static_cast<int>(i));
  return found;
}

template <class T>
std::vector<T> picked(const std::vector<T>& all, const std::vector<int>& which) {
  std::vector<T> some;
  some.reserve(which.size());
  for (int i : which) some.push_back(all[i]);
  return some;
}

void take_names(const Mesh& mesh, const Marks& in, const std::vector<int>& to, Mesh& part) {
  const FaceTable known(part.hexes);
  for (const auto& [name, faces] : mesh.surfaces) {
    auto& mine = part.surfaces[name];
    for (const Quad& q : faces)
      if (all_in(q, in))
        if (const Quad here = translated(q, to); known.first(here) >= 0) mine.push_back(here);
  }
  for (const auto& [name, set] : mesh.node_sets) {
    auto& mine = part.node_sets[name];
    for (int n : set)
      if (in[n]) mine.push_back(to[n]);
  }
  for (const auto& [name, group] : mesh.bars) {
    auto& mine = part.bars[name];
    for (const Bar& b : group)
      if (all_in(b.a.nodes, in) && all_in(b.b.nodes, in))
        mine.push_back(
            {{translated(b.a.nodes, to), b.a.weights}, {translated(b.b.nodes, to), b.b.weights}, b.share});
  }
}

// Nodes that a rank's LocalMesh may have, and those of no hexahedron, which may have a bar.
Marks needed_nodes(const Mesh& mesh, const Labels& whole, int rank, const std::set<std::string>& shared) {
  Marks needed(mesh.points.size(), true);
  const auto mark = [&](const auto& nodes, bool value) {
    for (int n : nodes) needed[n] = value;
  };
  for (const Hex& h : mesh.hexes) mark(h, false);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    if (whole.rank[h] == rank) mark(mesh.hexes[h], true);
  for (const std::string& name : shared)
    for (const Quad& q : mesh.surfaces.at(name)) mark(q, true);
  for (const auto& [name, group] : mesh.bars)
    for (const Bar& b : group) mark(b.a.nodes, true), mark(b.b.nodes, true);
  return needed;
}

}  // namespace

Labels labels_of(const Mesh& mesh, std::span<const int> rank_of_hex) {
  Labels whole{std::vector<int>(mesh.points.size()),
               std::vector<int>(mesh.hexes.size()),
               {rank_of_hex.begin(), rank_of_hex.end()}};
  std::iota(whole.node.begin(), whole.node.end(), 0);
  std::iota(whole.hex.begin(), whole.hex.end(), 0);
  return whole;
}

Extract extract(const Mesh& mesh, const Marks& hexes, Marks nodes) {
  Extract e;
  e.hexes = marked(hexes);
  for (int h : e.hexes)
    for (int n : mesh.hexes[h]) nodes[n] = true;
  e.nodes = marked(nodes);
  std::vector<int> to(mesh.points.size(), -1);
  for (std::size_t i = 0; i < e.nodes.size(); ++i) to[e.nodes[i]] = static_cast<int>(i);
  e.mesh.points = picked(mesh.points, e.nodes);
  if (mesh.parameters.size() == mesh.points.size())
    e.mesh.parameters = picked(mesh.parameters, e.nodes), e.mesh.place = mesh.place;
  e.mesh.region = picked(mesh.region, e.hexes);
  e.mesh.region_names = mesh.region_names;
  e.mesh.hexes.reserve(e.hexes.size());
  for (int h : e.hexes) e.mesh.hexes.push_back(translated(mesh.hexes[h], to));
  take_names(mesh, nodes, to, e.mesh);
  return e;
}

MeshPart part_of(const Mesh& mesh, const Labels& whole, int rank, const std::set<std::string>& shared) {
  const Marks needed = needed_nodes(mesh, whole, rank, shared);
  Marks hexes(mesh.hexes.size());
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    hexes[h] = std::ranges::any_of(mesh.hexes[h], [&](int n) { return needed[n]; });
  Extract e = extract(mesh, hexes, needed);
  MeshPart part{std::move(e.mesh),
                {picked(whole.node, e.nodes), picked(whole.hex, e.hexes), picked(whole.rank, e.hexes)}};
  for (std::size_t i = 0; i < e.nodes.size(); ++i)
    if (!needed[e.nodes[i]]) part.whole.node[i] = -1;
  return part;
}

}  // namespace bulbus::inline mesh
