#pragma once
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/pack.hpp"
#include "core/mesh/distributed/local_mesh.hpp"
#include "core/problem/rigid_body.hpp"
#include "core/problem/state.hpp"

namespace bulbus::inline problem {

/// One constrained direction of a node: n·u = value(s), with s the part of the step done.
struct Constraint {
  int node;
  Vec3<double> direction;
  std::function<double(double s)> value;
};

/// u = T q + ū, in the one place where it is applied. Nodes keep three components each: constrained
/// directions are projected out, du = P q with P = I − Σ n nᵀ, and appear as identity rows; nodes of rigid
/// bodies follow six unknowns of their body.
///
/// A primal vector on one rank: 3 numbers per owned node, then, on rank 0, 6 per rigid body.
class DofMap {
 public:
  DofMap(const LocalMesh& mesh, std::vector<RigidBody> bodies);

  /// Replaces the constraints called `name`; those of a node are orthonormalised in the order of their names.
  void constrain(const std::string& name, std::vector<Constraint> constraints);
  /// Those called `name`, and those whose names go on behind a blank. False where there are none.
  bool release(const std::string& name);
  /// From now on every hold stays where it is at s = 1.
  void freeze();
  /// What steps before the present one prescribe: direction and place of every hold. Read before the next
  /// build().
  void serialize(Archive& archive);
  /// To be called after a change of constraints. Throws InputError where two of one node contradict each
  /// other.
  void build();

  const LocalMesh& mesh() const { return mesh_; }
  std::span<const RigidBody> bodies() const { return bodies_; }
  int primal_size() const { return 3 * mesh_.owned + tail_size(); }
  int tail_size() const { return mesh_.comm.rank() == 0 ? 6 * static_cast<int>(bodies_.size()) : 0; }

  /// Free directions only: v ← P v on all local nodes, or on the owned ones if v has no more; nodes of bodies
  /// become zero.
  void project(std::span<double> v) const;
  void project(std::span<NodeSingle> v) const;
  /// y += factor · (I − P) x on owned nodes, bodies' nodes included.
  void add_constrained(std::span<const double> x, double factor, std::span<double> y) const;
  /// Local nodal increment of a primal vector (ghosts included). Collective.
  void expand(const State& state, std::span<const double> primal, std::span<double> dx) const;
  /// The transpose, for nodal forces already accumulated on their owners; constrained rows become zero.
  /// Collective.
  void reduce(const State& state, std::span<const double> force, std::span<double> primal) const;
  /// The parts of bodies' nodes in these two: `primal` may be its bodies' part alone; force and moment of
  /// every body. Collective.
  void expand_bodies(const State& state, std::span<const double> primal, std::span<double> dx) const;
  std::vector<double> reduce_bodies(const State& state, std::span<const double> force) const;
  /// ū increments that remain: Σ n (value(s) − n·u) for every local node. Returns the largest. Throws
  /// InputError on every rank where a formula is not finite. Collective.
  double prescribed_increment(const State& state, double s, std::span<double> du) const;
  /// x += step · dx for nodes and poses; rigid nodes are placed again. Collective.
  void move(State& state, std::span<const double> dx, std::span<const double> primal, double step) const;

  /// `factor` times the motions of the rigid bodies from one position to another: a primal vector's tail on
  /// every rank.
  std::vector<double> motion(std::span<const Pose> from, std::span<const Pose> to, double factor) const;

  /// 3×3 matrix of P for a local node (identity where nothing is constrained; zero for a rigid node).
  Mat3<double> projector(int node) const;
  bool constrained(int node) const { return slot_[node] >= 0 || body_of_[node] >= 0; }
  /// Are all three displacements of the node prescribed? Not so of the nodes of a rigid body.
  bool fully_constrained(int node) const {
    return body_of_[node] < 0 && slot_[node] >= 0 && nodes_[slot_[node]].count == 3;
  }
  int body_of(int node) const { return body_of_[node]; }
  /// Is this direction of the node constrained?
  bool constrains(int node, const Vec3<double>& d) const;
  /// Number of free displacement unknowns of all ranks, rigid ones included. Collective.
  long long free_unknowns() const;
  std::vector<double> bodies_part(
      std::span<const double> primal) const;  ///< 6 per body on every rank. Collective.

 private:
  struct Node {
    int node, count = 0;
    std::array<Vec3<double>, 3> normal;                  // orthonormal
    std::array<std::function<double(double)>, 3> value;  // of each normal
    Vec3<double> free_part(Vec3<double> v) const;
  };
  void add(Node& node, const Constraint& constraint, const std::string& name) const;

  const LocalMesh& mesh_;
  std::vector<RigidBody> bodies_;
  std::vector<int> body_of_, slot_;
  std::map<std::string, std::vector<Constraint>> constraints_;
  std::set<std::string> moving_;  // names of the constraints since freeze()
  std::vector<Node> nodes_;
};

}  // namespace bulbus::inline problem
