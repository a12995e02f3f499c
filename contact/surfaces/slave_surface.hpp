#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/tensor.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline contact {

/// Which components of a normal vanish at each of `nodes`: on the planes ("x", "y", "z") of `symmetry`, where
/// that coordinate is 0.
std::vector<std::array<bool, 3>> mirrored(std::span<const double> X, std::span<const int> nodes,
                                          std::span<const std::string> symmetry);

/// The owned nodes of a surface with what its faces give them: outward normal and tributary area,
///     normal ∥ Σ ∫ N_I (a×b) dξdη,   area = Σ ∫ N_I |a×b| dξdη     (2×2 Gauss)
/// A node on a symmetry plane has no normal component across it, as if the mirrored faces were there.
class SlaveSurface {
 public:
  struct Shape {
    std::vector<Vec3<double>> normals;  ///< unit, out of the body; zero where the faces' normals cancel
    std::vector<double> areas;          ///< mm²
  };

  /// `X`: reference positions of the local nodes, the first `owned` of them owned; `faces`: all that touch an
  /// owned node; nodes in `excluded` (ascending) are left out; `symmetry`: the planes ("x", "y", "z") where
  /// that coordinate is 0.
  SlaveSurface(std::span<const double> X, int owned, std::span<const Quad> faces,
               std::span<const int> excluded, std::span<const std::string> symmetry);

  /// Ascending.
  std::span<const int> nodes() const { return nodes_; }
  std::span<const Quad> faces() const { return faces_; }
  /// Of each of them among the faces that were given.
  std::span<const int> numbers() const { return numbers_; }
  Shape shape(std::span<const double> x) const;

 private:
  std::vector<Quad> faces_;
  std::vector<int> numbers_;
  std::vector<std::array<int, 4>> corners_;  // index in nodes_ of each face's corners, −1: not one of them
  std::vector<int> nodes_;
  std::vector<std::array<bool, 3>> mirrored_;
};

}  // namespace bulbus::inline contact
