#include "core/problem/contact_nodes.hpp"

#include <algorithm>

#include "core/mesh/faces.hpp"

namespace bulbus::inline problem {

ContactNodes::ContactNodes(const Mesh& mesh, const Model& model) {
  for (const ContactSpec& c : model.contacts)
    if (mesh.surfaces.contains(c.slave) && mesh.surfaces.contains(c.master))
      contacts_.push_back(
          {nodes_of_faces(mesh.surfaces.at(c.slave)), nodes_of_faces(mesh.surfaces.at(c.master))});
}

bool ContactNodes::join(int node, std::span<const int> others) const {
  const auto across = [&](const std::vector<int>& here, const std::vector<int>& there) {
    return std::ranges::binary_search(here, node) &&
           std::ranges::all_of(others, [&](int n) { return std::ranges::binary_search(there, n); });
  };
  return std::ranges::any_of(
      contacts_, [&](const Sides& s) { return across(s.slave, s.master) || across(s.master, s.slave); });
}

}  // namespace bulbus::inline problem
