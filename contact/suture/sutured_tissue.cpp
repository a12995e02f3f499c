#include "contact/suture/sutured_tissue.hpp"

#include <algorithm>

#include "core/base/sort_unique.hpp"

namespace bulbus::inline contact {
namespace {

// Indices in the Mesh of some local nodes, of all ranks, ascending; with their positions.
std::vector<int> gathered(const LocalMesh& mesh, const std::vector<int>& nodes,
                          std::vector<Point>* places = nullptr) {
  const auto drawn = mesh.drawn_places();
  std::vector<double> mine;
  for (int n : nodes)
    if (n < mesh.owned)
      mine.insert(mine.end(), {static_cast<double>(mesh.input_node[n]), drawn[3 * n], drawn[3 * n + 1],
                               drawn[3 * n + 2]});
  const auto all = mesh.comm.gather(std::span<const double>(mine));
  std::vector<std::array<double, 4>> rows(all.size() / 4);
  for (std::size_t i = 0; i < all.size(); ++i) rows[i / 4][i % 4] = all[i];
  std::sort(rows.begin(), rows.end());
  std::vector<int> input;
  for (const auto& row : rows) {
    input.push_back(static_cast<int>(row[0]));
    if (places) places->push_back({row[1], row[2], row[3]});
  }
  return input;
}

template <class Nodes>
void renumber(Nodes& nodes, const std::vector<int>& input) {
  for (int& n : nodes) n = static_cast<int>(std::ranges::lower_bound(input, n) - input.begin());
}

}  // namespace

SuturedTissue sutured_tissue(const LocalMesh& mesh, const SutureSpec& spec) {
  SuturedTissue t;
  t.mesh.region_names = mesh.region_names;
  for (const auto& [name, nodes] : mesh.sets) t.mesh.node_sets[name];
  for (const auto& [name, faces] : mesh.surfaces) t.mesh.surfaces[name];
  std::vector<int> nodes;
  for (const std::string& set : spec.sets)
    if (const auto* found = mesh.nodes_of(set)) nodes.insert(nodes.end(), found->begin(), found->end());
  const auto shared = mesh.shared.find(spec.surface);
  if (shared != mesh.shared.end())
    for (const Quad& q : shared->second) nodes.insert(nodes.end(), q.begin(), q.end());
  sort_unique(nodes);
  t.input = gathered(mesh, nodes, &t.mesh.points);

  for (const std::string& set : spec.sets)
    if (const auto* found = mesh.nodes_of(set))
      renumber(t.mesh.node_sets[set] = gathered(mesh, *found), t.input);
  if (shared != mesh.shared.end())
    for (Quad q : shared->second) {
      for (int& n : q) n = mesh.input_node[n];
      renumber(q, t.input);
      t.mesh.surfaces[spec.surface].push_back(q);
    }
  return t;
}

}  // namespace bulbus::inline contact
