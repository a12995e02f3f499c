#include "precond/schur/checkerboard_assembly.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <numeric>

namespace bulbus::inline precond {
CheckerboardMatrix::Assembly::Assembly(const CoupledSystem& system, CheckerboardMatrix& to)
    : problem_(system.problem()),
      to_(to),
      count_(to.modes_->count()),
      coarser_(to.modes_->coarser()),
      corners_(problem_.mesh().hexes, problem_.mesh().nodes()),
      constraints_(problem_.mesh().hexes.size()) {
  system.solid().visit_constraints([&](int hex, std::span<const int> nodes, std::span<const double> b) {
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = 3 * (std::ranges::find(nodes, problem_.mesh().hexes[hex][corner]) - nodes.begin());
      for (int i = 0; i < 3; ++i) constraints_[hex][3 * corner + i] = static_cast<float>(b[at + i]);
    }
  });
  exchange();
}

// use(coarser hexahedron, force) of every hexahedron around a node; force() makes the force on it
template <class Use>
void CheckerboardMatrix::Assembly::visit(int node, Use use) const {
  for (const auto c : corners_.at(node))
    if (const int hex = c.hex(), coarser = to_.modes_->coarser_of(hex); coarser >= 0)
      use(coarser, [&] {
        return Force(Eigen::Vector3f::Map(&constraints_[hex][3 * c.corner()]) * to_.modes_->row(hex));
      });
  for (auto f = std::ranges::lower_bound(foreign_, node, {}, &NodeForce::node);
       f != foreign_.end() && f->node == node; ++f)
    use(f->coarse, [&]() -> const Force& { return f->force; });
}

void CheckerboardMatrix::Assembly::add_lines(const LineJacobi& lines) {
  row_.resize(coarser_);
  for (int line = 0; line < lines.count(); ++line) {
    find_columns(lines.nodes(line));
    couple();
  }
  for (int row = 0; row < coarser_; ++row) {
    start_.push_back(to_.pairs_.size());
    for (int column : row_[row]) to_.pairs_.push_back({row, column});
    std::vector<int>().swap(row_[row]);
  }
  constexpr int beyond = 6;  // numbers that are loaded along with the last row
  to_.blocks_.resize(to_.pairs_.size() * count_ * count_ + beyond);
  for (int line = 0; line < lines.count(); ++line) add(line, lines);
}

void CheckerboardMatrix::Assembly::find_columns(std::span<const int> nodes) {
  columns_.clear();
  for (int n : nodes) visit(n, [&](int coarse, const auto&) { columns_.push_back(coarse); });
  std::ranges::sort(columns_);
  columns_.erase(std::unique(columns_.begin(), columns_.end()), columns_.end());
}

void CheckerboardMatrix::Assembly::couple() {
  std::vector<int> both;
  for (std::size_t a = 0; a < columns_.size(); ++a) {
    auto& row = row_[columns_[a]];
    const auto more = std::span(columns_).subspan(a);
    if (std::ranges::includes(row, more)) continue;
    both.clear();
    std::ranges::set_union(row, more, std::back_inserter(both));
    row = both;
  }
}

void CheckerboardMatrix::Assembly::add(int line, const LineJacobi& lines) {
  const auto nodes = lines.nodes(line);
  find_columns(nodes);
  F_.setZero(3 * nodes.size(), count_ * columns_.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    visit(nodes[i], [&](int coarse, const auto& force) {
      F_.block(3 * i, count_ * (std::ranges::lower_bound(columns_, coarse) - columns_.begin()), 3, count_) +=
          force();
    });
    if (problem_.dofs().constrained(nodes[i])) constrain(nodes[i], 3 * i);
  }
  const Eigen::MatrixXf energy = lines.energy(line, F_);
  for (std::size_t a = 0; a < columns_.size(); ++a) {
    std::size_t at = start_[columns_[a]];
    for (std::size_t b = a; b < columns_.size(); ++b) {
      while (to_.pairs_[at].column != columns_[b]) ++at;
      LineJacobi::Rows::Map(&to_.blocks_[count_ * count_ * at], count_, count_) +=
          energy.block(count_ * a, count_ * b, count_, count_);
    }
  }
}

void CheckerboardMatrix::Assembly::constrain(int node, Eigen::Index row) {
  const Mat3<double> given = problem_.dofs().projector(node);
  Eigen::Matrix3f projector;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) projector(i, j) = static_cast<float>(given(i, j));
  F_.middleRows<3>(row) = (projector * F_.middleRows<3>(row)).eval();
}

// One for each coarser hexahedron that acts on a node.
std::vector<CheckerboardMatrix::Assembly::NodeForce> CheckerboardMatrix::Assembly::sums(int node) const {
  std::vector<NodeForce> all;
  visit(node, [&](int coarse, const auto& force) {
    const auto at = std::ranges::find(all, coarse, &NodeForce::coarse);
    if (at == all.end())
      all.push_back({node, coarse, force()});
    else
      at->force += force();
  });
  return all;
}

// Of every force: the node's place in the halo, the coarser hexahedron, the numbers.
void CheckerboardMatrix::Assembly::exchange() {
  const LocalMesh& mesh = problem_.mesh();
  std::vector<std::vector<long long>> out(mesh.comm.size());
  std::vector<Halo::Neighbour> neighbours;
  for (const auto& n : mesh.halo.neighbours()) {
    std::vector<int> sent;
    for (std::size_t place = 0; place < n.receive.size(); ++place)
      for (const NodeForce& f : sums(n.receive[place])) {
        sent.push_back(f.coarse);
        out[n.rank].push_back(static_cast<long long>(place));
        out[n.rank].push_back(to_.modes_->labels()[f.coarse]);
        for (float v : f.force.reshaped()) out[n.rank].push_back(std::bit_cast<int>(v));
      }
    std::ranges::sort(sent);
    sent.erase(std::unique(sent.begin(), sent.end()), sent.end());
    neighbours.push_back({n.rank, std::move(sent), {}});
  }
  const auto in = mesh.comm.exchange(out);
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    receive(in[neighbours[k].rank], mesh.halo.neighbours()[k].send, neighbours[k].receive);
  std::ranges::stable_sort(foreign_, {}, &NodeForce::node);
  to_.halo_ = std::make_unique<Halo>(mesh.comm, std::move(neighbours));
}

// Both sides have coarser hexahedra in the order of their labels.
void CheckerboardMatrix::Assembly::receive(std::span<const long long> data, std::span<const int> nodes,
                                           std::vector<int>& ghosts) {
  const std::size_t size = 2 + 3 * count_;
  std::vector<long long> labels;
  for (std::size_t i = 0; i < data.size(); i += size) labels.push_back(data[i + 1]);
  std::ranges::sort(labels);
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  const int first = coarser_;
  coarser_ += static_cast<int>(labels.size());
  ghosts.resize(labels.size());
  std::iota(ghosts.begin(), ghosts.end(), first);
  for (; !data.empty(); data = data.subspan(size)) {
    NodeForce f{nodes[data[0]],
                first + static_cast<int>(std::ranges::lower_bound(labels, data[1]) - labels.begin()),
                Force(3, count_)};
    for (int i = 0; i < f.force.size(); ++i)
      f.force.reshaped()[i] = std::bit_cast<float>(static_cast<int>(data[2 + i]));
    foreign_.push_back(f);
  }
}

}  // namespace bulbus::inline precond
