#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/problem/state.hpp"

namespace bulbus::inline problem {

/// A region that moves as one: six unknowns (shift, then spin about the current centre) in place of its
/// nodes.
class RigidBody {
 public:
  using Six = std::array<double, 6>;

  /// `nodes`: local nodes (owned and ghost); `free`: which of the six unknowns exist (symmetry planes hold
  /// some).
  RigidBody(std::string name, std::vector<int> nodes, Vec3<double> center, std::array<bool, 6> free)
      : name_(std::move(name)), nodes_(std::move(nodes)), center_(center), free_(free) {}

  const std::string& name() const { return name_; }
  std::span<const int> nodes() const { return nodes_; }
  const std::array<bool, 6>& free() const { return free_; }

  /// Places its nodes.
  void place(const Pose& pose, std::span<const double> X, std::span<double> x) const;
  /// Moves a pose by an increment of the six unknowns: rotation ← exp(spin) rotation.
  Pose moved(const Pose& pose, const Six& q) const;
  /// dx of its nodes: shift + spin × r, with r = x − current centre.
  void expand(const Pose& pose, std::span<const double> x, const Six& q, std::span<double> dx) const;
  /// The transpose: force and moment of the nodal forces of this rank's owned nodes (not summed over ranks).
  Six reduce(const Pose& pose, std::span<const double> x, std::span<const double> f, int owned) const;
  /// Second derivative of the motion against nodal forces f: spin block of Σ [ ½(f⊗r + r⊗f) − (f·r) I ].
  Mat3<double> geometric(const Pose& pose, std::span<const double> x, std::span<const double> f,
                         int owned) const;
  Vec3<double> arm(const Pose& pose, std::span<const double> x, int node) const;

 private:
  std::string name_;
  std::vector<int> nodes_;
  Vec3<double> center_;
  std::array<bool, 6> free_;
};

/// exp of the spin vector (Rodrigues).
Mat3<double> rotation(const Vec3<double>& spin);
/// Its inverse, for rotations by less than half a turn.
Vec3<double> spin(const Mat3<double>& rotation);

}  // namespace bulbus::inline problem
