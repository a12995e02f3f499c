#include "core/mesh/distributed/mesh_levels.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/running_sums.hpp"

namespace bulbus::inline mesh {
namespace {

// Edges or faces of a part follow each other as in the whole, by their lowest node; labelled nodes have all
// of theirs. So the index of one in the whole is that of its node's first, plus its place among its node's.
std::vector<int> labels_by_lowest_node(std::span<const int> lowest, const MeshPart& part,
                                       const LocalMesh& local, long long first, long long& all) {
  std::vector<int> count(part.whole.node.size()), keys, owned, of_owned;
  for (int n : lowest) ++count[n];
  for (std::size_t n = 0; n < count.size(); ++n) {
    const int key = part.whole.node[n];
    if (key < 0) continue;
    keys.push_back(key);
    if (const int here = local.local(key); here < 0 || here >= local.owned) continue;
    owned.push_back(key);
    of_owned.push_back(count[n]);
  }
  const RunningSums sums(owned, of_owned, local.all_nodes, local.comm);
  const auto before = sums.before(keys);
  all = sums.total();
  if (first + all + local.all_hexes > std::numeric_limits<int>::max())
    throw input_error("the refined mesh has more nodes than can be numbered", "refine it less often");
  std::vector<int> labels;
  labels.reserve(lowest.size());
  auto next = lowest.begin();
  for (std::size_t n = 0, k = 0; n < count.size(); ++n) {
    const bool known = part.whole.node[n] >= 0;
    for (int i = 0; i < count[n]; ++i, ++next)
      labels.push_back(known ? static_cast<int>(first + before[k] + i) : -1);
    k += known;
  }
  return labels;
}

// Lowest parents of the new nodes that have so many.
std::vector<int> lowest_parents(const RefinedMesh& r, int parents) {
  std::vector<int> lowest;
  for (std::size_t i = 0; i + 1 < r.start.size(); ++i)
    if (r.start[i + 1] - r.start[i] == parents) lowest.push_back(r.parents[r.start[i]]);
  return lowest;
}

// In the whole refined mesh: the coarser nodes, then those of edges, of faces and of hexahedra.
Labels refined_labels(const MeshPart& part, const RefinedMesh& r, const LocalMesh& local) {
  Labels fine{part.whole.node, {}, {}};
  fine.node.reserve(r.mesh.points.size());
  long long first = local.all_nodes, all = 0;
  for (int parents : {2, 4}) {
    const auto labels = labels_by_lowest_node(lowest_parents(r, parents), part, local, first, all);
    fine.node.insert(fine.node.end(), labels.begin(), labels.end());
    first += all;
  }
  for (int h : part.whole.hex) fine.node.push_back(static_cast<int>(first + h));
  fine.hex.reserve(r.mesh.hexes.size());
  fine.rank.reserve(r.mesh.hexes.size());
  for (std::size_t h = 0; h < part.whole.hex.size(); ++h)
    for (int c = 0; c < 8; ++c) {
      fine.hex.push_back(8 * part.whole.hex[h] + c);
      fine.rank.push_back(part.whole.rank[h]);
    }
  return fine;
}

// The parents of labelled nodes, by their labels.
class LabelledParents {
 public:
  LabelledParents(const Labels& coarse, const RefinedMesh& r, const Labels& fine)
      : coarse_(coarse), r_(r), fine_(fine) {
    for (int n = 0; n < static_cast<int>(fine.node.size()); ++n)
      if (fine.node[n] >= 0) labelled_.push_back(n);
  }
  std::vector<int> operator()(int label) const {
    const int node = *std::ranges::lower_bound(labelled_, label, {}, [&](int n) { return fine_.node[n]; });
    auto parents = r_.parents_of(node);
    for (int& p : parents) p = coarse_.node[p];
    return parents;
  }

 private:
  const Labels& coarse_;
  const RefinedMesh& r_;
  const Labels& fine_;
  std::vector<int> labelled_;  // nodes of the part, and so their labels, ascending
};

}  // namespace

std::vector<MeshLevel> distribute_levels(const Mesh& base, int refinements, const Comm& comm,
                                         const std::set<std::string>& shared) {
  const Labels whole = labels_of(base, partition(base, comm.size()));
  std::vector<MeshLevel> levels;
  const auto add = [&](const Mesh& mesh, const Labels& labels) {
    auto local = std::make_unique<LocalMesh>(distribute(mesh, labels, comm, shared));
    local->refinements = static_cast<int>(levels.size());
    levels.push_back({std::move(local), nullptr});
  };
  add(base, whole);
  if (refinements == 0) return levels;
  MeshPart part = part_of(base, whole, comm.rank(), shared);
  for (int i = 1; i <= refinements; ++i) {
    RefinedMesh r = refine(part.mesh);
    const Labels fine = refined_labels(part, r, *levels.back().mesh);
    add(r.mesh, fine);
    levels[i].prolongation = std::make_unique<const Prolongation>(LabelledParents(part.whole, r, fine),
                                                                  *levels[i - 1].mesh, *levels[i].mesh);
    if (i < refinements) part = part_of(r.mesh, fine, comm.rank(), shared);
  }
  return levels;
}

}  // namespace bulbus::inline mesh
