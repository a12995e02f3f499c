#include "core/mesh/local_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/base/memory.hpp"

namespace bulbus {
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

void sort_unique(std::vector<int>& v) {
  std::sort(v.begin(), v.end());
  v.erase(std::unique(v.begin(), v.end()), v.end());
}

// Per rank, the Mesh nodes that its hexahedra, bars and shared surfaces touch but that others own.
std::vector<std::vector<int>> ghosts_by_rank(const Mesh& mesh, std::span<const int> rank_of_hex,
                                             const std::vector<int>& owner, int size, const std::set<std::string>& shared) {
  std::vector<std::vector<int>> ghosts(size);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int n : mesh.hexes[h])
      if (owner[n] != rank_of_hex[h]) ghosts[rank_of_hex[h]].push_back(n);
  for (const auto& [name, group] : mesh.bars)
    for (const Bar& bar : group)
      for_each_node(bar, [&](int n) {
        if (owner[n] != rank_of(bar, owner)) ghosts[rank_of(bar, owner)].push_back(n);
      });
  for (const std::string& name : shared)
    for (const Quad& q : mesh.surfaces.at(name))
      for (int n : q)
        for (int r = 0; r < size; ++r)
          if (owner[n] != r) ghosts[r].push_back(n);
  for (auto& g : ghosts) sort_unique(g);
  return ghosts;
}

struct Numbering {
  std::vector<int> owner;
  std::vector<long long> number;     // Mesh node → global number
  std::vector<long long> first;      // per rank
};

Numbering renumber(std::vector<int> owner, int size) {
  Numbering n{std::move(owner), {}, std::vector<long long>(size + 1, 0)};
  for (int o : n.owner) ++n.first[o + 1];
  std::partial_sum(n.first.begin(), n.first.end(), n.first.begin());
  std::vector<long long> next(n.first.begin(), n.first.end() - 1);
  for (int o : n.owner) n.number.push_back(next[o]++);
  return n;
}

std::vector<Halo::Neighbour> neighbours(const std::vector<std::vector<int>>& ghosts, const std::vector<int>& owner,
                                        const std::vector<int>& local, int me) {
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

void take_hexes(const Mesh& mesh, std::span<const int> rank_of_hex, const std::vector<int>& local, LocalMesh& m) {
  for (int region = 0; region < static_cast<int>(mesh.region_names.size()); ++region) {
    m.regions.push_back({static_cast<int>(m.hexes.size()), 0});
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
      if (mesh.region[h] != region || rank_of_hex[h] != m.comm.rank()) continue;
      Hex hex = mesh.hexes[h];
      for (int& n : hex) n = local[n];
      m.hexes.push_back(hex);
      m.input_hex.push_back(static_cast<int>(h));
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
void take_surfaces(const Mesh& mesh, std::span<const int> rank_of_hex, const std::vector<int>& local, LocalMesh& m) {
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

}  // namespace

LocalMesh distribute(const Mesh& mesh, std::span<const int> rank_of_hex, const Comm& comm, const std::set<std::string>& shared) {
  const int me = comm.rank();
  const Numbering n = renumber(node_owners(mesh, rank_of_hex), comm.size());
  const auto ghosts = ghosts_by_rank(mesh, rank_of_hex, n.owner, comm.size(), shared);

  std::vector<int> input, local(mesh.points.size(), -1);
  for (int i = 0; i < static_cast<int>(mesh.points.size()); ++i)
    if (n.owner[i] == me) input.push_back(i);
  const int owned = static_cast<int>(input.size());
  input.insert(input.end(), ghosts[me].begin(), ghosts[me].end());
  for (std::size_t i = 0; i < input.size(); ++i) local[input[i]] = static_cast<int>(i);

  LocalMesh m{.comm = comm,
              .owned = owned,
              .first_node = n.first[me],
              .all_nodes = n.first.back(),
              .region_names = mesh.region_names,
              .halo = Halo(comm, neighbours(ghosts, n.owner, local, me))};
  m.input_node = input;
  for (int i : input) {
    m.number.push_back(n.number[i]);
    m.X.insert(m.X.end(), mesh.points[i].begin(), mesh.points[i].end());
  }
  take_hexes(mesh, rank_of_hex, local, m);
  take_surfaces(mesh, rank_of_hex, local, m);
  for (const std::string& name : shared)
    for (Quad q : mesh.surfaces.at(name)) {
      for (int& node : q) node = local[node];
      m.shared[name].push_back(q);
    }
  take_bars(mesh, n.owner, local, m);
  return m;
}

std::vector<int> LocalMesh::local(std::span<const int> mesh_nodes) const {
  // input_node ascends within the owned nodes and within the ghosts
  std::vector<int> found;
  const auto middle = input_node.begin() + owned;
  for (int n : mesh_nodes)
    for (auto [first, last] : {std::pair{input_node.begin(), middle}, std::pair{middle, input_node.end()}})
      if (auto at = std::lower_bound(first, last, n); at != last && *at == n)
        found.push_back(static_cast<int>(at - input_node.begin()));
  return found;
}

std::size_t LocalMesh::bytes() const {
  std::size_t total = bytes_of(X) + bytes_of(number) + bytes_of(input_node) + bytes_of(hexes) + bytes_of(input_hex);
  for (const auto& [name, faces] : surfaces) total += bytes_of(faces);
  for (const auto& [name, faces] : shared) total += bytes_of(faces);
  for (const auto& [name, group] : bars) total += bytes_of(group);
  return total;
}

}  // namespace bulbus
