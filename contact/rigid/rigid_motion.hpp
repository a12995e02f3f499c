#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contact/rigid/rigid_surface.hpp"
#include "core/problem/spec/rigid_spec.hpp"
#include "core/problem/state.hpp"

namespace bulbus::inline contact {

/// Where the tissue that a body may touch is: 3 numbers per point.
struct SlavePlaces {
  std::vector<double> points;   ///< mm
  std::vector<double> normals;  ///< out of the tissue, unit or zero; none: the points have no side
};

/// Moves the parts of a rigid surface through the steps. Every part has its pose about its own centre c:
/// x = c + shift + rotation (X − c). Works the same on every rank without communication.
class RigidMotion {
 public:
  /// Sets surface->places from here on.
  explicit RigidMotion(std::shared_ptr<RigidSurface> surface);

  /// A step begins that moves the body. `slaves`: what it may touch now, of ALL ranks; read only where the
  /// move counts from touch, which is with points whose surface does not look the way that the part moves.
  /// `key` is the path of the move in the scene.
  /// Throws InputError if a part has no direction to close along, or never meets a slave.
  void begin(const MoveSpec& move, const SlavePlaces& slaves, const std::string& key);
  /// Places at the part s of the step done.
  void set_progress(double s);
  /// All parts a way (mm) further along their own directions than the step's motion has them, till its end.
  void set_closing(double way);
  /// The end of the step stays.
  void freeze();

  void serialize(Archive& archive);

  /// Where the parts are now.
  const std::vector<Pose>& poses() const { return now_; }
  void set_poses(std::vector<Pose> poses);

 private:
  struct Course {
    std::optional<RotationSpec> rotate;
    Vec3<double> translate{0, 0, 0};
    double close = 0;
  };
  Pose at(std::size_t part, double s) const;
  Vec3<double> inwards(std::size_t part) const;
  void bring_to_touch(const MoveSpec& move, const SlavePlaces& slaves, const std::string& key);
  void place();

  std::shared_ptr<RigidSurface> surface_;
  std::vector<Pose> start_, now_;
  Course course_;
  double closing_ = 0, progress_ = 0;
};

/// Way along the unit vector `direction` after which a part, coming from far behind, first meets one of the
/// points (3 each), mm; negative if it has passed them, infinite if it meets none. Exact for points against
/// facets and the curved surface that they stand for. Edges and corners of the body may reach the faces
/// between the points earlier: contact acts on nodes, so it does not see that either.
double way_to_touch(const RigidSurface& surface, const RigidSurface::Part& part,
                    const Vec3<double>& direction, std::span<const double> points);

}  // namespace bulbus::inline contact
