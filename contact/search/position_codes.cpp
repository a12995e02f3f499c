#include "contact/search/position_codes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/base/sort_unique.hpp"

namespace bulbus::inline contact {
namespace {

using Code = std::uint64_t;
constexpr double most_cells = 1 << 20;  // per direction: three of them fit into a code

struct Box {
  std::array<double, 3> low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  void add(const double* p) {
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  }
  bool meets(const Box& b) const {
    for (int c = 0; c < 3; ++c)
      if (!(b.high[c] >= low[c] && b.low[c] <= high[c])) return false;
    return true;
  }
  double extent() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
  Box wider(double by) const {
    Box b = *this;
    for (int c = 0; c < 3; ++c) b.low[c] -= by, b.high[c] += by;
    return b;
  }
};

Box box_of(const std::array<int, 3>& triangle, std::span<const double> places, double inflation) {
  Box b;
  for (int n : triangle) b.add(&places[3 * n]);
  return b.wider(inflation);
}

std::vector<Box> boxes_of(std::span<const double> points, int group) {
  std::vector<Box> boxes(points.size() / (3 * group));
  for (std::size_t i = 0; i < points.size() / 3; ++i) boxes[i / group].add(&points[3 * i]);
  return boxes;
}

std::vector<double> middles_of(const std::vector<Box>& boxes) {
  std::vector<double> middles;
  for (const Box& b : boxes)
    for (int c = 0; c < 3; ++c) middles.push_back(.5 * (b.low[c] + b.high[c]));
  return middles;
}

// Points sorted by the number of their cell; cells along x follow one another.
class Cells {
 public:
  Cells(std::span<const double> points, double size) {
    const int n = static_cast<int>(points.size() / 3);
    for (int i = 0; i < n; ++i) box_.add(&points[3 * i]);
    size_ = std::max({size, box_.extent() / most_cells, 1e-300});
    for (int c = 0; c < 3; ++c) count_[c] = static_cast<Code>((box_.high[c] - box_.low[c]) / size_) + 1;
    std::vector<std::pair<Code, int>> coded(n);
    for (int i = 0; i < n; ++i)
      coded[i] = {code(cell(points[3 * i], 0), cell(points[3 * i + 1], 1), cell(points[3 * i + 2], 2)), i};
    std::sort(coded.begin(), coded.end());
    point_.reserve(n);
    for (const auto& [code, i] : coded) {
      if (codes_.empty() || codes_.back() != code) {
        codes_.push_back(code);
        start_.push_back(static_cast<int>(point_.size()));
      }
      point_.push_back(i);
    }
    start_.push_back(n);
  }

  template <class Visit>
  void visit(const Box& b, Visit visit) const {
    for (int c = 0; c < 3; ++c)
      if (!(b.high[c] >= box_.low[c] && b.low[c] <= box_.high[c])) return;
    std::array<Code, 3> first, last;
    for (int c = 0; c < 3; ++c) first[c] = cell(b.low[c], c), last[c] = cell(b.high[c], c);
    for (Code z = first[2]; z <= last[2]; ++z)
      for (Code y = first[1]; y <= last[1]; ++y) {
        const Code end = code(last[0], y, z);
        auto at = std::lower_bound(codes_.begin(), codes_.end(), code(first[0], y, z)) - codes_.begin();
        for (; at < static_cast<long>(codes_.size()) && codes_[at] <= end; ++at)
          for (int k = start_[at]; k < start_[at + 1]; ++k) visit(point_[k]);
      }
  }

 private:
  Code cell(double x, int c) const {
    return static_cast<Code>(std::clamp((x - box_.low[c]) / size_, 0., static_cast<double>(count_[c] - 1)));
  }
  Code code(Code x, Code y, Code z) const { return (z * count_[1] + y) * count_[0] + x; }

  Box box_;
  double size_;
  std::array<Code, 3> count_;
  std::vector<Code> codes_;  // of the cells that hold points, ascending
  std::vector<int> start_, point_;
};

}  // namespace

Candidates find_candidates(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                           std::span<const double> places, double inflation, int group) {
  Candidates found{.group = group};
  const std::vector<Box> boxes = boxes_of(points, group);
  const int n = static_cast<int>(boxes.size());
  found.start.assign(n + 1, 0);
  if (n == 0 || triangles.empty()) return found;
  double size = 0, half = 0;
  for (const auto& t : triangles) size += box_of(t, places, inflation).extent();
  for (const Box& b : boxes) half = std::max(half, .5 * b.extent());
  const Cells cells(middles_of(boxes), size / static_cast<double>(triangles.size()));
  const auto visit_pairs = [&](auto use) {
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
      const Box box = box_of(triangles[t], places, inflation);
      cells.visit(box.wider(1.001 * half), [&](int i) {
        if (box.meets(boxes[i])) use(i, t);
      });
    }
  };
  // counted first: a list of all pairs would need three times the room of the candidates
  visit_pairs([&](int i, int) { ++found.start[i + 1]; });
  for (int i = 0; i < n; ++i) found.start[i + 1] += found.start[i];
  found.triangles.resize(found.start.back());
  std::vector<std::size_t> next(found.start.begin(), found.start.end() - 1);
  visit_pairs([&](int i, int t) { found.triangles[next[i]++] = t; });
  return found;
}

const Candidates& GlobalSearch::update(std::span<const double> points,
                                       std::span<const std::array<int, 3>> triangles,
                                       std::span<const double> places, double reach) {
  reach = std::max(reach, least_reach_);
  if (searches_ > 0 && reach <= reach_ && motion(points, places) <= margin_ / 2) return candidates_;
  reach_ = reach;
  if (searches_ == 0) {
    for (const auto& t : triangles) corners_.insert(corners_.end(), t.begin(), t.end());
    sort_unique(corners_);
    corner_places_.resize(3 * corners_.size());
  }
  points_.assign(points.begin(), points.end());
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (int c = 0; c < 3; ++c) corner_places_[3 * i + c] = places[3 * corners_[i] + c];
  candidates_ = {};  // before the new ones: two would need the room of both
  candidates_ = find_candidates(points, triangles, places, reach_ + margin_, group_);
  ++searches_;
  return candidates_;
}

double GlobalSearch::motion(std::span<const double> points, std::span<const double> places) const {
  double most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) most = std::max(most, std::abs(points[i] - points_[i]));
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(places[3 * corners_[i] + c] - corner_places_[3 * i + c]));
  return most;
}

}  // namespace bulbus::inline contact
