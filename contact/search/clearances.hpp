#pragma once
#include <span>
#include <vector>

namespace bulbus::inline contact {

/// Largest distance between two positions of one point, 3 numbers each.
double greatest_motion(std::span<const double> now, std::span<const double> before);

/// Which points are too far from the surface to matter: each once measured, less what points and surface have
/// moved since.
class Clearances {
 public:
  /// Where points and surface are now, 3 numbers each; always the same ones.
  void move(std::span<const double> points, std::span<const double> surface);
  bool far(int point) const { return until_[point] > way_; }
  /// `distance`: that the point is from where it matters, mm.
  void set(int point, double distance) { until_[point] = way_ + distance; }

 private:
  double way_ = 0;             // an upper bound of all relative motion so far, mm
  std::vector<double> until_;  // way_ at which the point may matter again
  std::vector<double> points_, surface_;
};

}  // namespace bulbus::inline contact
