#include "core/problem/connected_parts.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/disjoint_sets.hpp"

namespace bulbus::inline problem {
namespace {

// Number of this rank's part of every node, from 0; −1 outside of the regions.
std::vector<int> own_parts(const LocalMesh& mesh, const std::vector<SolidRegion>& regions, int& count) {
  DisjointSets sets(mesh.nodes());
  std::vector<int> part(mesh.nodes(), -1);
  for (const SolidRegion& r : regions)
    for (int h = r.first; h < r.first + r.count; ++h)
      for (int n : mesh.hexes[h]) sets.join(n, mesh.hexes[h][0]);
  std::map<int, int> number;
  for (const SolidRegion& r : regions)
    for (int h = r.first; h < r.first + r.count; ++h)
      for (int n : mesh.hexes[h])
        if (part[n] < 0)
          part[n] = number.emplace(sets.root(n), static_cast<int>(number.size())).first->second;
  count = static_cast<int>(number.size());
  return part;
}

}  // namespace

ConnectedParts connected_parts(const LocalMesh& mesh, const std::vector<SolidRegion>& regions) {
  const Comm& comm = mesh.comm;
  int own = 0;
  ConnectedParts parts;
  parts.of_node = own_parts(mesh, regions, own);
  const long long first = comm.offset(static_cast<long long>(own)),
                  all = comm.sum(static_cast<long long>(own));
  // ghosts learn what their owners call the part: pairs of names of one part
  std::vector<double> theirs(parts.of_node.begin(), parts.of_node.end());
  for (double& p : theirs)
    if (p >= 0) p += static_cast<double>(first);
  mesh.halo.update_ghosts(theirs, 1);
  std::set<std::pair<long long, long long>> pairs;
  for (int n = mesh.owned; n < mesh.nodes(); ++n)
    if (parts.of_node[n] >= 0 && theirs[n] >= 0)
      pairs.emplace(first + parts.of_node[n], static_cast<long long>(theirs[n]));
  std::vector<long long> flat;
  for (const auto& [a, b] : pairs) flat.insert(flat.end(), {a, b});
  const auto known = comm.gather(std::span<const long long>(flat));
  DisjointSets sets(static_cast<int>(all));
  std::vector<int> number(all, -1);
  for (std::size_t i = 0; i < known.size(); i += 2)
    sets.join(static_cast<int>(known[i]), static_cast<int>(known[i + 1]));
  for (int p = 0; p < static_cast<int>(all); ++p) {
    int& of_root = number[sets.root(p)];
    if (of_root < 0) of_root = parts.count++;
  }
  for (int& p : parts.of_node)
    if (p >= 0) p = number[sets.root(static_cast<int>(first) + p)];
  // which regions a part has, told by the ranks that hold them
  std::vector<double> has(parts.count * regions.size());
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (int h = regions[r].first; h < regions[r].first + regions[r].count; ++h)
      has[parts.of_node[mesh.hexes[h][0]] * regions.size() + r] = 1;
  comm.max(has);
  parts.names.resize(parts.count);
  for (std::size_t i = 0; i < has.size(); ++i)
    if (has[i] > 0) {
      std::string& name = parts.names[i / regions.size()];
      name += (name.empty() ? "region '" : " and '") + regions[i % regions.size()].name + "'";
    }
  return parts;
}

}  // namespace bulbus::inline problem
