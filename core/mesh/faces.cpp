#include "core/mesh/faces.hpp"

#include <algorithm>

#include "core/base/sort_unique.hpp"
#include "core/mesh/sorted.hpp"

namespace bulbus::inline mesh {
namespace {

int lowest(const Quad& q) { return std::min(std::min(q[0], q[1]), std::min(q[2], q[3])); }

int node_count(const std::vector<Hex>& hexes) {
  int n = 0;
  for (const Hex& h : hexes) n = std::max(n, 1 + *std::max_element(h.begin(), h.end()));
  return n;
}

}  // namespace

const std::array<std::array<int, 4>, 6> hex_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Quad face_nodes(const std::vector<Hex>& hexes, int face) {
  const Hex& h = hexes[face / 6];
  const auto& f = hex_faces[face % 6];
  return {h[f[0]], h[f[1]], h[f[2]], h[f[3]]};
}

std::vector<int> outer_faces(const std::vector<Hex>& hexes) {
  const FaceTable table(hexes);
  std::vector<int> outer;
  for (int f = 0; f < 6 * static_cast<int>(hexes.size()); ++f)
    if (table.count(face_nodes(hexes, f)) == 1) outer.push_back(f);
  return outer;
}

std::vector<int> nodes_of_faces(const std::vector<Quad>& faces) {
  std::vector<int> nodes;
  nodes.reserve(4 * faces.size());
  for (const Quad& q : faces) nodes.insert(nodes.end(), q.begin(), q.end());
  sort_unique(nodes);
  return nodes;
}

FaceTable::FaceTable(const std::vector<Hex>& hexes) : hexes_(&hexes), start_(node_count(hexes) + 1, 0) {
  const int faces = 6 * static_cast<int>(hexes.size());
  std::vector<int> low(faces);
  for (int f = 0; f < faces; ++f) ++start_[(low[f] = lowest(face_nodes(hexes, f))) + 1];
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  entries_.resize(faces);
  for (int f = 0; f < faces; ++f) entries_[next[low[f]]++] = f;
}

int FaceTable::first(const Quad& nodes) const {
  const int low = lowest(nodes);
  if (low < 0 || low + 1 >= static_cast<int>(start_.size())) return -1;
  const Quad key = sorted(nodes);
  for (std::size_t e = start_[low]; e < start_[low + 1]; ++e)
    if (sorted(face_nodes(*hexes_, entries_[e])) == key) return entries_[e];
  return -1;
}

int FaceTable::directed(const Quad& nodes) const {
  const int low = lowest(nodes);
  if (low < 0 || low + 1 >= static_cast<int>(start_.size())) return -1;
  for (std::size_t e = start_[low]; e < start_[low + 1]; ++e) {
    Quad turned = face_nodes(*hexes_, entries_[e]);
    for (int i = 0; i < 4; ++i) {
      if (turned == nodes) return entries_[e];
      std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    }
  }
  return -1;
}

int FaceTable::count(const Quad& nodes) const {
  const int low = lowest(nodes);
  if (low < 0 || low + 1 >= static_cast<int>(start_.size())) return 0;
  const Quad key = sorted(nodes);
  return static_cast<int>(std::count_if(entries_.begin() + start_[low], entries_.begin() + start_[low + 1],
                                        [&](int f) { return sorted(face_nodes(*hexes_, f)) == key; }));
}

}  // namespace bulbus::inline mesh
