// How a LocalMesh is taken from a part of a mesh.
#include "core/mesh/distributed/local_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/base/sort_unique.hpp"
#include "core/mesh/faces.hpp"

namespace bulbus::inline mesh {
namespace {

// Bars go to the owner of their first node.
int rank_of(const Bar& bar, const std::vector<int>& owner) { return owner[bar.a.nodes[0]]; }

template <class Use>
void for_each_node(const Bar& bar, Use use) {
  for (const EmbeddedPoint* p : {&bar.a, &bar.b})
    for (int i = 0; i < 4; ++i)
      if (p->weights[i] != 0) use(p->nodes[i]);
}

std::vector<int> node_owners(const Mesh& mesh, std::span<const int> rank_of_hex) {
  constexpr int none = 1 << 30;
  std::vector<int> owner(mesh.points.size(), none);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h]) owner[n] = std::min(owner[n], rank_of_hex[h]);
  for (int& o : owner)
    if (o == none) o = 0;  // a node of bars only
  return owner;
}

// Per rank, the nodes that its hexahedra, bars and shared surfaces touch but that others own: all of them for
// this rank, those that this rank owns for others.
std::vector<std::vector<int>> ghosts_by_rank(const Mesh& mesh, std::span<const int> rank_of_hex,
                                             const std::vector<int>& owner, const Comm& comm,
                                             const std::set<std::string>& shared) {
  std::vector<std::vector<int>> ghosts(comm.size());
  const auto needs = [&](int rank, int n) {
    if (owner[n] != rank && (owner[n] == comm.rank() || rank == comm.rank())) ghosts[rank].push_back(n);
  };
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h]) needs(rank_of_hex[h], n);
  for (const auto& [name, group] : mesh.bars)
    for (const Bar& bar : group) for_each_node(bar, [&](int n) { needs(rank_of(bar, owner), n); });
  for (const std::string& name : shared)
    for (const Quad& q : mesh.surfaces.at(name))
      for (int n : q)
        for (int r = 0; r < comm.size(); ++r) needs(r, n);
  for (auto& g : ghosts) sort_unique(g);
  return ghosts;
}

std::vector<Halo::Neighbour> neighbours(const std::vector<std::vector<int>>& ghosts,
                                        const std::vector<int>& owner, const std::vector<int>& local,
                                        int me) {
  std::vector<Halo::Neighbour> all;
  for (int r = 0; r < static_cast<int>(ghosts.size()); ++r) {
    Halo::Neighbour n{r, {}, {}};
    if (r != me) {
      for (int g : ghosts[r])
        if (owner[g] == me) n.send.push_back(local[g]);
      for (int g : ghosts[me])
        if (owner[g] == r) n.receive.push_back(local[g]);
    }
    if (!n.send.empty() || !n.receive.empty()) all.push_back(std::move(n));
  }
  return all;
}

// A rank's own nodes in the order in which its hexahedra meet them, region by region, so that neighbours lie
// together in memory; then those that it has none around.
std::vector<int> owned_nodes(const Mesh& mesh, std::span<const int> rank_of_hex,
                             const std::vector<int>& owner, int me) {
  std::vector<int> nodes;
  std::vector<bool> met(owner.size());
  const auto meet = [&](int n) {
    if (owner[n] == me && !met[n]) nodes.push_back(n);
    met[n] = true;
  };
  for (int region = 0; region < static_cast<int>(mesh.region_names.size()); ++region)
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
      if (mesh.region[h] == region && rank_of_hex[h] == me) std::ranges::for_each(mesh.hexes[h], meet);
  for (int n = 0; n < static_cast<int>(owner.size()); ++n) meet(n);
  return nodes;
}

// Global numbers: each rank's owned nodes in a run.
void number_nodes(LocalMesh& m) {
  m.first_node = m.comm.offset(static_cast<long long>(m.owned));
  m.all_nodes = m.comm.sum(static_cast<long long>(m.owned));
  std::vector<double> number(m.nodes());  // exact up to 2⁵³
  std::iota(number.begin(), number.begin() + m.owned, static_cast<double>(m.first_node));
  m.halo.update_ghosts(number, 1);
  m.number.assign(number.begin(), number.end());
}

void take_hexes(const Mesh& mesh, const Labels& whole, const std::vector<int>& local, LocalMesh& m) {
  const auto mine = static_cast<std::size_t>(std::ranges::count(whole.rank, m.comm.rank()));
  m.hexes.reserve(mine);
  m.input_hex.reserve(mine);
  for (int region = 0; region < static_cast<int>(mesh.region_names.size()); ++region) {
    m.regions.push_back({static_cast<int>(m.hexes.size()), 0});
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
      if (mesh.region[h] != region || whole.rank[h] != m.comm.rank()) continue;
      Hex hex = mesh.hexes[h];
      for (int& n : hex) n = local[n];
      m.hexes.push_back(hex);
      m.input_hex.push_back(whole.hex[h]);
      ++m.regions.back().count;
    }
  }
  const long long count = static_cast<long long>(m.hexes.size());
  m.first_hex = m.comm.offset(count);
  m.all_hexes = m.comm.sum(count);
}

struct KeyHash {
  std::size_t operator()(const Quad& q) const {
    std::size_t h = 0;
    for (int n : q) h = h * 1000003u + static_cast<std::size_t>(n);
    return h;
  }
};

Quad key_of(Quad q) {
  std::sort(q.begin(), q.end());
  return q;
}

// The rank of every named face: that of the first hexahedron that has it.
void take_surfaces(const Mesh& mesh, std::span<const int> rank_of_hex, const std::vector<int>& local,
                   LocalMesh& m) {
  std::unordered_map<Quad, int, KeyHash> rank;
  for (const auto& [name, faces] : mesh.surfaces)
    for (const Quad& q : faces) rank.emplace(key_of(q), -1);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (const auto& f : hex_faces) {
      const Hex& hex = mesh.hexes[h];
      const auto found = rank.find(key_of({hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]}));
      if (found != rank.end() && found->second < 0) found->second = rank_of_hex[h];
    }
  for (const auto& [name, faces] : mesh.surfaces) {
    auto& mine = m.surfaces[name];
    for (Quad q : faces)
      if (rank.at(key_of(q)) == m.comm.rank()) {
        for (int& n : q) n = local[n];
        mine.push_back(q);
      }
  }
}

void take_bars(const Mesh& mesh, const std::vector<int>& owner, const std::vector<int>& local, LocalMesh& m) {
  for (const auto& [name, group] : mesh.bars) {
    auto& mine = m.bars[name];
    auto& input = m.input_bar[name];
    for (std::size_t i = 0; i < group.size(); ++i) {
      if (rank_of(group[i], owner) != m.comm.rank()) continue;
      Bar bar = group[i];
      for (EmbeddedPoint* p : {&bar.a, &bar.b})
        for (int k = 0; k < 4; ++k) p->nodes[k] = p->weights[k] != 0 ? local[p->nodes[k]] : 0;
      mine.push_back(bar);
      input.push_back(static_cast<int>(i));
    }
  }
}

// Members of a name as local nodes; nodes that are not held drop out.
std::vector<int> held(const std::vector<int>& nodes, const std::vector<int>& local) {
  std::vector<int> found;
  for (int n : nodes)
    if (local[n] >= 0) found.push_back(local[n]);
  return found;
}

std::vector<int> held_of_region(const Mesh& mesh, int region, const std::vector<int>& local) {
  std::vector<bool> in(mesh.points.size());
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    if (mesh.region[h] == region)
      for (int n : mesh.hexes[h]) in[n] = true;
  std::vector<int> found;
  for (std::size_t n = 0; n < in.size(); ++n)
    if (in[n] && local[n] >= 0) found.push_back(local[n]);
  return found;
}

void take_sets(const Mesh& mesh, const std::vector<int>& local, LocalMesh& m) {
  for (auto [name, set] : mesh.node_sets) {
    sort_unique(set);
    m.sets[name] = held(set, local);
  }
  for (const auto& [name, faces] : mesh.surfaces)
    if (!m.sets.contains(name)) m.sets[name] = held(nodes_of_faces(faces), local);
  for (int r = 0; r < static_cast<int>(mesh.region_names.size()); ++r)
    m.region_nodes.push_back(held_of_region(mesh, r, local));
}

}  // namespace

LocalMesh distribute(const Mesh& mesh, std::span<const int> rank_of_hex, const Comm& comm,
                     const std::set<std::string>& shared) {
  return distribute(mesh, labels_of(mesh, rank_of_hex), comm, shared);
}

LocalMesh distribute(const Mesh& mesh, const Labels& whole, const Comm& comm,
                     const std::set<std::string>& shared) {
  const int me = comm.rank();
  const auto owner = node_owners(mesh, whole.rank);
  const auto ghosts = ghosts_by_rank(mesh, whole.rank, owner, comm, shared);

  auto nodes = owned_nodes(mesh, whole.rank, owner, me);
  std::vector<int> local(mesh.points.size(), -1);
  const int owned = static_cast<int>(nodes.size());
  nodes.insert(nodes.end(), ghosts[me].begin(), ghosts[me].end());
  for (std::size_t i = 0; i < nodes.size(); ++i) local[nodes[i]] = static_cast<int>(i);

  LocalMesh m{.comm = comm,
              .owned = owned,
              .region_names = mesh.region_names,
              .halo = Halo(comm, neighbours(ghosts, owner, local, me))};
  m.input_node.reserve(nodes.size());
  m.X.reserve(3 * nodes.size());
  for (int n : nodes) {
    m.input_node.push_back(whole.node[n]);
    m.X.insert(m.X.end(), mesh.points[n].begin(), mesh.points[n].end());
  }
  m.by_input.resize(nodes.size());
  std::iota(m.by_input.begin(), m.by_input.end(), 0);
  std::ranges::sort(m.by_input, {}, [&](int n) { return m.input_node[n]; });
  number_nodes(m);
  take_hexes(mesh, whole, local, m);
  take_surfaces(mesh, whole.rank, local, m);
  for (const std::string& name : shared)
    for (Quad q : mesh.surfaces.at(name)) {
      for (int& node : q) node = local[node];
      m.shared[name].push_back(q);
    }
  take_bars(mesh, owner, local, m);
  take_sets(mesh, local, m);
  return m;
}

}  // namespace bulbus::inline mesh
