#pragma once
#include <memory>
#include <string>
#include <vector>

#include "contact/rigid/convex_outline.hpp"
#include "contact/rigid/rigid_surface.hpp"
#include "contact/surfaces/meridians.hpp"
#include "contact/suture/suture_points.hpp"
#include "core/mesh/distributed/local_mesh.hpp"
#include "core/problem/term.hpp"

namespace bulbus::inline contact {

/// The strings of one suture (formulation, section 6): each of its points S = Σ w x is pulled with the force
/// F d, d = (T − S)/|T − S|, along the outer tangent to the outline of a rigid body in the plane through S.
/// Residual of a node: −F d w. Plane and direction follow S, with the tangent F q qᵀ/ℓ, q across d in the
/// plane (exact although T moves: along d, to first order), and what the turning of the plane adds, which is
/// not symmetric. Of a suture that does not follow they are those of the last converged increment.
///
/// Where a point has come to lie inside the outline or on it, its last converged direction stays.
class SutureTerm final : public Term {
 public:
  /// One string as it pulls now, the same on every rank.
  struct String {
    Vec3<double> S{}, T{}, direction{};  ///< mm; unit vector
    double force = 0;                    ///< of the whole model, N
    bool lost = false;                   ///< S is inside the outline: the direction is an older one
  };

  /// `mesh` stays where it is; `body` is moved elsewhere. `key` is the path of the spec in the scene.
  /// Collective. Throws InputError.
  SutureTerm(const LocalMesh& mesh, const std::vector<SuturePoint>& points,
             std::shared_ptr<const RigidSurface> body, const SutureSpec& spec, std::string key);

  /// Force per point at the end of the coming step, N, reached linearly. To be called before begin_step().
  void sew(double force) { end_ = force; }
  const std::vector<String>& strings() const { return strings_; }

  /// Collective where a suture follows.
  void add_residual(const State& state, std::span<double> force,
                    std::span<double> reference_force) const override;
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>& state) const override;
  bool symmetric() const override { return !follow_; }
  /// Throws InputError if the suture pulls and a string has no tangent. Collective.
  void begin_step(int step, const State& state) override;
  void set_progress(double s) override;
  void freeze() override;
  /// Collective.
  void commit(const State& state) override;
  void serialize(Archive& archive) override;

 private:
  struct Patch {
    std::vector<int> nodes;  // local
    std::vector<double> weights;
  };
  struct Bite {
    Patch owned;  // the force acts on these
    Patch near;   // the tangent on these, on one rank: exact where ghosts of all the others reach it
    std::array<bool, 3> on_plane{};
    double share = 1;
  };
  struct Tangent;
  // A string from S: where it meets the outline, its direction and the one across it in the plane, the
  // plane's normal (unit vectors), and its free length, mm.
  struct Pull {
    Vec3<double> T, direction, across, normal;
    double length;
  };
  bool idle() const { return start_ == 0 && end_ == 0; }
  std::vector<Vec3<double>> places(const State& state) const;
  CuttingPlane plane_through(const Vec3<double>& S) const;
  std::optional<Pull> pull(const Vec3<double>& S) const;
  Mat3<double> turn(const Vec3<double>& S, const Pull& at) const;
  void update(const State& state);

  const LocalMesh& mesh_;
  std::shared_ptr<const RigidSurface> body_;
  MeridianFrame frame_;
  Vec3<double> generator_;
  bool follow_;
  std::string key_;
  std::vector<Bite> bites_;
  std::vector<String> strings_;
  double start_ = 0, end_ = 0, now_ = 0;
};

}  // namespace bulbus::inline contact
