#include "core/mesh/distributed/local_mesh.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus::inline mesh {

int LocalMesh::local(int mesh_node) const {
  const auto at = std::ranges::lower_bound(by_input, mesh_node, {}, [&](int n) { return input_node[n]; });
  return at != by_input.end() && input_node[*at] == mesh_node ? *at : -1;
}

std::vector<int> LocalMesh::local(std::span<const int> mesh_nodes) const {
  std::vector<int> found;
  for (int n : mesh_nodes)
    if (const int here = local(n); here >= 0) found.push_back(here);
  return found;
}

const std::vector<int>* LocalMesh::nodes_of(const std::string& name) const {
  if (const auto set = sets.find(name); set != sets.end()) return &set->second;
  const auto region = std::ranges::find(region_names, name);
  return region != region_names.end() ? &region_nodes[region - region_names.begin()] : nullptr;
}

std::size_t LocalMesh::bytes() const {
  std::size_t total = bytes_of(X) + bytes_of(number) + bytes_of(input_node) + bytes_of(by_input) +
                      bytes_of(hexes) + bytes_of(input_hex);
  for (const auto& [name, faces] : surfaces) total += bytes_of(faces);
  for (const auto& [name, faces] : shared) total += bytes_of(faces);
  for (const auto& [name, group] : bars) total += bytes_of(group);
  for (const auto& [name, nodes] : sets) total += bytes_of(nodes);
  for (const auto& nodes : region_nodes) total += bytes_of(nodes);
  return total;
}

}  // namespace bulbus::inline mesh
