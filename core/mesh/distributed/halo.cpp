#include "core/mesh/distributed/halo.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr int tag = 71;

constexpr MPI_Datatype type_of(double) { return MPI_DOUBLE; }
constexpr MPI_Datatype type_of(float) { return MPI_FLOAT; }

template <class Number>
std::vector<Number> packed(std::span<const Number> v, const std::vector<int>& nodes, int width) {
  std::vector<Number> out;
  out.reserve(width * nodes.size());
  for (int n : nodes) out.insert(out.end(), v.begin() + width * n, v.begin() + width * (n + 1));
  return out;
}

// Sends values of `give` nodes to every neighbour, hands what arrives for its `take` nodes to `use`.
template <class Number, class Give, class Take, class Use>
void exchange(const Comm& comm, const std::vector<Halo::Neighbour>& neighbours, std::span<const Number> v,
              int width, Give give, Take take, Use use) {
  std::vector<std::vector<Number>> out, in;
  std::vector<MPI_Request> requests(2 * neighbours.size());
  auto request = requests.begin();
  for (const auto& n : neighbours) {
    auto& buffer = in.emplace_back(width * take(n).size());
    MPI_Irecv(buffer.data(), static_cast<int>(buffer.size()), type_of(Number()), n.rank, tag, comm.raw(),
              &*request++);
  }
  for (const auto& n : neighbours) {
    const auto& buffer = out.emplace_back(packed(v, give(n), width));
    ++traffic().messages;
    traffic().bytes += static_cast<long long>(buffer.size() * sizeof(Number));
    MPI_Isend(buffer.data(), static_cast<int>(buffer.size()), type_of(Number()), n.rank, tag, comm.raw(),
              &*request++);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const auto& nodes = take(neighbours[k]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int c = 0; c < width; ++c) use(width * nodes[i] + c, in[k][width * i + c]);
  }
}

template <class Number>
void send_to_ghosts(const Comm& comm, const std::vector<Halo::Neighbour>& neighbours, std::span<Number> v,
                    int width) {
  if (neighbours.empty()) return;
  exchange<Number>(
      comm, neighbours, v, width, [](const auto& n) -> auto& { return n.send; },
      [](const auto& n) -> auto& { return n.receive; }, [&](int i, Number x) { v[i] = x; });
}

template <class Number>
void fold_ghosts(const Comm& comm, const std::vector<Halo::Neighbour>& neighbours, std::span<Number> v,
                 int width) {
  if (neighbours.empty()) return;
  exchange<Number>(
      comm, neighbours, v, width, [](const auto& n) -> auto& { return n.receive; },
      [](const auto& n) -> auto& { return n.send; }, [&](int i, Number x) { v[i] += x; });
}

}  // namespace

void Halo::update_ghosts(std::span<double> v, int width) const {
  send_to_ghosts(comm_, neighbours_, v, width);
}
void Halo::accumulate_ghosts(std::span<double> v, int width) const {
  fold_ghosts(comm_, neighbours_, v, width);
}
void Halo::update_ghosts(std::span<float> v, int width) const {
  send_to_ghosts(comm_, neighbours_, v, width);
}
void Halo::update_ghosts(std::span<NodeSingle> v) const { send_to_ghosts(comm_, neighbours_, numbers(v), 4); }
void Halo::accumulate_ghosts(std::span<NodeSingle> v) const {
  fold_ghosts(comm_, neighbours_, numbers(v), 4);
}

}  // namespace bulbus::inline mesh
