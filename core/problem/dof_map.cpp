#include "core/problem/dof_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/problem/formula.hpp"

namespace bulbus::inline problem {

DofMap::DofMap(const LocalMesh& mesh, std::vector<RigidBody> bodies)
    : mesh_(mesh), bodies_(std::move(bodies)), body_of_(mesh.nodes(), -1), slot_(mesh.nodes(), -1) {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (int n : bodies_[b].nodes()) body_of_[n] = static_cast<int>(b);
}

void DofMap::constrain(const std::string& name, std::vector<Constraint> constraints) {
  constraints_[name] = std::move(constraints);
  moving_.insert(name);
}

bool DofMap::release(const std::string& name) {
  return std::erase_if(constraints_, [&](const auto& one) {
           return one.first == name || one.first.starts_with(name + " ");
         }) > 0;
}

void DofMap::freeze() {
  for (auto& [name, constraints] : constraints_)
    for (Constraint& h : constraints) h.value = [end = h.value(1)](double) { return end; };
  moving_.clear();
}

void DofMap::serialize(Archive& archive) {
  for (auto& [name, constraints] : constraints_) {
    if (moving_.contains(name)) continue;
    Archive::Keys nodes;
    std::vector<double> rows;
    for (const Constraint& h : constraints) {
      nodes.add(mesh_.input_node[h.node], h.node < mesh_.owned);
      rows.insert(rows.end(), {h.direction[0], h.direction[1], h.direction[2], h.value(1)});
    }
    archive.rows("hold " + name, nodes, 4, rows);
    for (std::size_t i = 0; i < constraints.size(); ++i)
      constraints[i] = {constraints[i].node,
                        {rows[4 * i], rows[4 * i + 1], rows[4 * i + 2]},
                        [end = rows[4 * i + 3]](double) { return end; }};
  }
}

// Gram-Schmidt: a direction that the others span already must ask for what they give.
void DofMap::add(Node& node, const Constraint& constraint, const std::string& name) const {
  Vec3<double> n = constraint.direction;
  std::array<double, 3> along{};
  for (int k = 0; k < node.count; ++k) {
    along[k] = dot(n, node.normal[k]);
    for (int c = 0; c < 3; ++c) n[c] -= along[k] * node.normal[k][c];
  }
  const double length = norm(n);
  auto rest = [value = constraint.value, along, before = node.value, count = node.count](double s) {
    double v = value(s);
    for (int k = 0; k < count; ++k) v -= along[k] * before[k](s);
    return v;
  };
  if (length < 1e-8) {
    for (double s : looked_at)
      if (const double gap = rest(s); std::abs(gap) > 1e-9 * (1 + std::abs(constraint.value(s))))
        throw input_error(
            fmt::format("over-constrained: node {} at ({:.4g}, {:.4g}, {:.4g}) is given two displacements in "
                        "one direction that differ by {:.3g} mm, one of them by '{}'",
                        mesh_.input_node[node.node] + 1, mesh_.X[3 * node.node], mesh_.X[3 * node.node + 1],
                        mesh_.X[3 * node.node + 2], gap, name.substr(name.find(' ') + 1)),
            "Take the node out of one of the sets, or give both the same displacement.");
    return;
  }
  for (double& c : n) c /= length;
  node.normal[node.count] = n;
  node.value[node.count++] = [rest, length](double s) { return rest(s) / length; };
}

void DofMap::build() {
  nodes_.clear();
  std::fill(slot_.begin(), slot_.end(), -1);
  for (const auto& [name, constraints] : constraints_)
    for (const Constraint& h : constraints) {
      if (body_of_[h.node] >= 0) continue;
      if (slot_[h.node] < 0) {
        slot_[h.node] = static_cast<int>(nodes_.size());
        nodes_.push_back({h.node});
      }
      add(nodes_[slot_[h.node]], h, name);
    }
}

Mat3<double> DofMap::projector(int node) const {
  Mat3<double> P{};
  if (body_of_[node] >= 0) return P;
  for (int i = 0; i < 3; ++i) P(i, i) = 1;
  if (slot_[node] < 0) return P;
  const Node& h = nodes_[slot_[node]];
  if (h.count == 3) return Mat3<double>{};
  for (int k = 0; k < h.count; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) -= h.normal[k][i] * h.normal[k][j];
  return P;
}

bool DofMap::constrains(int node, const Vec3<double>& d) const {
  const Mat3<double> P = projector(node);
  double left = 0;
  for (int i = 0; i < 3; ++i) left += std::abs(P(i, 0) * d[0] + P(i, 1) * d[1] + P(i, 2) * d[2]);
  return left < 1e-8;
}

Vec3<double> DofMap::Node::free_part(Vec3<double> v) const {
  for (int k = 0; k < count; ++k) {
    const double along = dot(normal[k], v);
    for (int c = 0; c < 3; ++c) v[c] -= along * normal[k][c];
  }
  return v;
}

void DofMap::project(std::span<double> v) const {
  const int nodes = static_cast<int>(v.size() / 3);
  for (const Node& h : nodes_) {
    if (h.node >= nodes) continue;
    const Vec3<double> free = h.free_part(at(v, h.node));
    std::ranges::copy(free, &v[3 * h.node]);
  }
  for (const RigidBody& b : bodies_)
    for (int n : b.nodes())
      if (n < nodes) v[3 * n] = v[3 * n + 1] = v[3 * n + 2] = 0;
}

void DofMap::project(std::span<NodeSingle> v) const {
  for (const Node& h : nodes_) {
    NodeSingle& at = v[h.node];
    at = rounded(h.free_part({at[0], at[1], at[2]}).data());
  }
  for (const RigidBody& b : bodies_)
    for (int n : b.nodes()) v[n] = NodeSingle{};
}

void DofMap::add_constrained(std::span<const double> x, double factor, std::span<double> y) const {
  for (const Node& h : nodes_) {
    if (h.node >= mesh_.owned) continue;
    for (int k = 0; k < h.count; ++k) {
      const double along = factor * dot(h.normal[k], at(x, h.node));
      for (int c = 0; c < 3; ++c) y[3 * h.node + c] += along * h.normal[k][c];
    }
  }
  for (const RigidBody& b : bodies_)
    for (int n : b.nodes())
      if (n < mesh_.owned)
        for (int i = 3 * n; i < 3 * n + 3; ++i) y[i] += factor * x[i];
}

std::vector<double> DofMap::bodies_part(std::span<const double> primal) const {
  std::vector<double> q(6 * bodies_.size());
  if (q.empty()) return q;
  if (mesh_.comm.rank() == 0) std::copy(primal.end() - q.size(), primal.end(), q.begin());
  mesh_.comm.broadcast(q);
  return q;
}

void DofMap::expand(const State& state, std::span<const double> primal, std::span<double> dx) const {
  std::copy_n(primal.begin(), 3 * mesh_.owned, dx.begin());
  mesh_.halo.update_ghosts(dx);
  project(dx);
  expand_bodies(state, primal, dx);
}

void DofMap::expand_bodies(const State& state, std::span<const double> primal, std::span<double> dx) const {
  const auto q = bodies_part(primal);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    RigidBody::Six six;
    std::copy_n(q.begin() + 6 * b, 6, six.begin());
    bodies_[b].expand(state.bodies[b], state.x, six, dx);
  }
}

void DofMap::reduce(const State& state, std::span<const double> force, std::span<double> primal) const {
  const auto q = reduce_bodies(state, force);
  if (mesh_.comm.rank() == 0) std::copy(q.begin(), q.end(), primal.end() - q.size());
  std::copy_n(force.begin(), 3 * mesh_.owned, primal.begin());
  project(primal.first(3 * mesh_.owned));
}

std::vector<double> DofMap::reduce_bodies(const State& state, std::span<const double> force) const {
  std::vector<double> q;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto six = bodies_[b].reduce(state.bodies[b], state.x, force, mesh_.owned);
    q.insert(q.end(), six.begin(), six.end());
  }
  if (!q.empty()) mesh_.comm.sum(q);
  return q;
}

double DofMap::prescribed_increment(const State& state, double s, std::span<double> du) const {
  std::fill(du.begin(), du.end(), 0.0);
  double largest = 0;
  mesh_.comm.together([&] {  // a formula may not be finite here
    for (const Node& h : nodes_) {
      const Vec3<double> u = minus(at(state.x, h.node), at(mesh_.X, h.node));
      for (int k = 0; k < h.count; ++k) {
        const double missing = h.value[k](s) - dot(h.normal[k], u);
        largest = std::max(largest, std::abs(missing));
        for (int c = 0; c < 3; ++c) du[3 * h.node + c] += missing * h.normal[k][c];
      }
    }
  });
  return mesh_.comm.max(largest);
}

void DofMap::move(State& state, std::span<const double> dx, std::span<const double> primal,
                  double step) const {
  for (std::size_t i = 0; i < state.x.size(); ++i) state.x[i] += step * dx[i];
  const auto q = bodies_part(primal);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    RigidBody::Six six;
    for (int i = 0; i < 6; ++i) six[i] = step * q[6 * b + i];
    state.bodies[b] = bodies_[b].moved(state.bodies[b], six);
    bodies_[b].place(state.bodies[b], mesh_.X, state.x);
  }
}

std::vector<double> DofMap::motion(std::span<const Pose> from, std::span<const Pose> to,
                                   double factor) const {
  std::vector<double> q;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Vec3<double> turn = spin(times_transposed(to[b].rotation, from[b].rotation));
    for (int c = 0; c < 3; ++c) q.push_back(factor * (to[b].shift[c] - from[b].shift[c]));
    for (double v : turn) q.push_back(factor * v);
  }
  return q;
}

long long DofMap::free_unknowns() const {
  long long constrained = 0;
  for (const Node& h : nodes_)
    if (h.node < mesh_.owned) constrained += h.count;
  for (const RigidBody& b : bodies_)
    constrained += 3 * std::ranges::count_if(b.nodes(), [&](int n) { return n < mesh_.owned; });
  long long rigid = 0;
  for (const RigidBody& b : bodies_) rigid += std::ranges::count(b.free(), true);
  return mesh_.comm.sum(3LL * mesh_.owned - constrained) + rigid;
}

}  // namespace bulbus::inline problem
