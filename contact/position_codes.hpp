#pragma once
#include <array>
#include <span>
#include <vector>

namespace bulbus {

/// Triangles near each of some points, ascending; triangles of point i: `triangles[start[i]] ... triangles[start[i + 1] - 1]`.
struct Candidates {
  std::vector<int> start{0}, triangles;
  std::span<const int> of(int point) const {
    return {triangles.data() + start[point], triangles.data() + start[point + 1]};
  }
};

/// Every pair of a point (3 numbers each) and a triangle whose bounding box, wider by `inflation` on all sides, holds the point.
/// By position code: the points' cells, numbered, are sorted once; a triangle finds the runs of cells that its box covers by
/// binary search. Cells are as large as the mean box, so the work grows with the number of points, triangles and pairs.
Candidates find_candidates(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                           std::span<const double> places, double inflation);

/// Keeps candidates that hold every triangle within `reach` of a point, and searches anew only when points or corners have moved
/// by more than half the margin since the last time.
class GlobalSearch {
 public:
  GlobalSearch(double reach, double margin) : reach_(reach), margin_(margin) {}
  /// The triangles must be the same in every call.
  const Candidates& update(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                           std::span<const double> places);
  int searches() const { return searches_; }

 private:
  double motion(std::span<const double> points, std::span<const double> places) const;

  double reach_, margin_;
  std::vector<int> corners_;                     // places in use
  std::vector<double> points_, corner_places_;   // at the last search
  Candidates candidates_;
  int searches_ = 0;
};

}  // namespace bulbus
