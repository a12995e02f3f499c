#include "core/mesh/halo.hpp"

namespace bulbus {
namespace {

constexpr int tag = 71;

std::vector<double> packed(std::span<const double> v, const std::vector<int>& nodes, int width) {
  std::vector<double> out;
  out.reserve(width * nodes.size());
  for (int n : nodes) out.insert(out.end(), v.begin() + width * n, v.begin() + width * (n + 1));
  return out;
}

// Sends values of `give` nodes to every neighbour, hands what arrives for its `take` nodes to `use`.
template <class Give, class Take, class Use>
void exchange(const Comm& comm, const std::vector<Halo::Neighbour>& neighbours, std::span<const double> v, int width,
              Give give, Take take, Use use) {
  std::vector<std::vector<double>> out, in;
  std::vector<MPI_Request> requests(2 * neighbours.size());
  auto request = requests.begin();
  for (const auto& n : neighbours) {
    auto& buffer = in.emplace_back(width * take(n).size());
    MPI_Irecv(buffer.data(), static_cast<int>(buffer.size()), MPI_DOUBLE, n.rank, tag, comm.raw(), &*request++);
  }
  for (const auto& n : neighbours) {
    const auto& buffer = out.emplace_back(packed(v, give(n), width));
    ++traffic().messages;
    traffic().bytes += static_cast<long long>(buffer.size() * sizeof(double));
    MPI_Isend(buffer.data(), static_cast<int>(buffer.size()), MPI_DOUBLE, n.rank, tag, comm.raw(), &*request++);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const auto& nodes = take(neighbours[k]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int c = 0; c < width; ++c) use(width * nodes[i] + c, in[k][width * i + c]);
  }
}

}  // namespace

void Halo::update(std::span<double> v, int width) const {
  if (neighbours_.empty()) return;
  exchange(
      comm_, neighbours_, v, width, [](const Neighbour& n) -> auto& { return n.send; },
      [](const Neighbour& n) -> auto& { return n.receive; }, [&](int i, double x) { v[i] = x; });
}

void Halo::fold(std::span<double> v, int width) const {
  if (neighbours_.empty()) return;
  exchange(
      comm_, neighbours_, v, width, [](const Neighbour& n) -> auto& { return n.receive; },
      [](const Neighbour& n) -> auto& { return n.send; }, [&](int i, double x) { v[i] += x; });
}

}  // namespace bulbus
