#include "app/eye/tear_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bulbus::inline eye {
namespace {

using Knots = std::vector<std::pair<double, double>>;

// Lines on each side of an edge over which its shift fades.
constexpr int fading = 3;
constexpr double shortest = 0.4, longest = 2.5;  // of cells, in their lengths before

double value(const Knots& knots, double at) {
  if (at <= knots.front().first) return knots.front().second;
  for (std::size_t k = 1; k < knots.size(); ++k)
    if (at <= knots[k].first) {
      const auto& from = knots[k - 1];
      const auto& to = knots[k];
      if (at == to.first) return to.second;
      return from.second + (at - from.first) / (to.first - from.first) * (to.second - from.second);
    }
  return knots.back().second;
}

bool keeps_cells(const Knots& shifts) {
  for (std::size_t k = 1; k < shifts.size(); ++k) {
    const double was = shifts[k].first - shifts[k - 1].first,
                 is = was + shifts[k].second - shifts[k - 1].second;
    if (!(is >= shortest * was && is <= longest * was)) return false;
  }
  return true;
}

// Shifts of lines so that line `back` lies at edges.back and `front` at edges.front.
Knots shifts_of_rings(const TearEdges& edges, std::span<const double> rings, int pinned, int back,
                      int front) {
  const int last = static_cast<int>(rings.size()) - 1;
  int behind = std::max(0, back - fading), ahead = std::min(last, front + fading);
  if (pinned < back) behind = std::max(behind, pinned);
  if (pinned > front) ahead = std::min(ahead, pinned);
  Knots shifts{{rings[behind], 0}, {rings[back], edges.back - rings[back]}};
  if (pinned > back && pinned < front) shifts.push_back({rings[pinned], 0});
  shifts.insert(shifts.end(), {{rings[front], edges.front - rings[front]}, {rings[ahead], 0}});
  return shifts;
}

double moved(const Knots& shifts) {
  double sum = 0;
  for (const auto& [at, shift] : shifts) sum += std::abs(shift);
  return sum;
}

int nearest(std::span<const double> lines, double to) {
  const auto way = [&](double line) { return std::abs(line - to); };
  return static_cast<int>(std::ranges::min_element(lines, {}, way) - lines.begin());
}

}  // namespace

TearLines::TearLines(const TearEdges& edges, std::span<const double> rings, double pinned,
                     std::span<const double> columns) {
  const int side = std::max(1, nearest(columns, edges.side)), far = side + fading;
  if (far >= static_cast<int>(columns.size())) return;
  shift_azimuth_ = {{0, 0}, {columns[side], edges.side - columns[side]}, {columns[far], 0}};
  weight_azimuth_ = {{columns[side], 1}, {columns[far], 0}};
  if (!keeps_cells(shift_azimuth_)) return;

  const int fixed = nearest(rings, pinned), last = static_cast<int>(rings.size()) - 1;
  double least = std::numeric_limits<double>::infinity();
  for (int back = 1; back < last; ++back)
    for (int front = back + 1; front < last; ++front) {
      if (back == fixed || front == fixed) continue;
      Knots shifts = shifts_of_rings(edges, rings, fixed, back, front);
      if (!keeps_cells(shifts) || moved(shifts) >= least) continue;
      least = moved(shifts);
      weight_t_ = {{shifts.front().first, 0}, {rings[back], 1}, {rings[front], 1}, {shifts.back().first, 0}};
      shift_t_ = std::move(shifts);
    }
}

std::pair<double, double> TearLines::operator()(double t, double azimuth) const {
  if (shift_t_.empty()) return {t, azimuth};
  return {t + value(weight_azimuth_, azimuth) * value(shift_t_, t),
          azimuth + value(weight_t_, t) * value(shift_azimuth_, azimuth)};
}

}  // namespace bulbus::inline eye
