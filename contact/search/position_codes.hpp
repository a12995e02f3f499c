#pragma once
#include <array>
#include <span>
#include <vector>

namespace bulbus::inline contact {

/// Triangles near each of some points, ascending. Points that follow one another share a list, `group` of
/// them; triangles of list i: `triangles[start[i]] ... triangles[start[i + 1] - 1]`.
struct Candidates {
  std::vector<std::size_t> start{0};
  std::vector<int> triangles;
  int group = 1;
  std::span<const int> of(int point) const {
    const int list = point / group;
    return {triangles.data() + start[list], triangles.data() + start[list + 1]};
  }
};

/// Every pair of a group of points (3 numbers each) and a triangle whose bounding box, wider by `inflation`
/// on all sides, meets the box of the group. By position code: the cells of the groups' middles, numbered,
/// are sorted once; a triangle finds the runs of cells that its box covers by binary search. Cells are as
/// large as the mean box, so the work grows with the number of groups, triangles and pairs.
Candidates find_candidates(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                           std::span<const double> places, double inflation, int group = 1);

/// Keeps candidates that hold every triangle within `reach` of a point, and searches anew only when points or
/// corners have moved by more than half the margin since the last time, or the reach is larger than it was
/// then.
class GlobalSearch {
 public:
  GlobalSearch(double reach, double margin, int group = 1)
      : least_reach_(reach), reach_(reach), margin_(margin), group_(group) {}
  /// The triangles must be the same in every call. `reach`: if larger than the least one.
  const Candidates& update(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                           std::span<const double> places, double reach = 0);
  int searches() const { return searches_; }

 private:
  double motion(std::span<const double> points, std::span<const double> places) const;

  double least_reach_, reach_, margin_;
  int group_;
  std::vector<int> corners_;                    // places in use
  std::vector<double> points_, corner_places_;  // at the last search
  Candidates candidates_;
  int searches_ = 0;
};

}  // namespace bulbus::inline contact
