#include "contact/law/contact_area.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bulbus::inline contact {
namespace {

constexpr int halvings = 30;     // to 1e-9 of an edge
constexpr double in_full = .01;  // of the mean pressure

// Mean of √d over the half edges beside a node at the distance θ from the end of contact, in lengths
double mean_root(double theta) {
  return 2. / 3 * (std::pow(theta + .5, 1.5) - std::pow(std::max(0., theta - .5), 1.5));
}

}  // namespace

// E* G m(θ) = 4/3 p length (1 − θ)^(3/2)
double part_in_contact(const NodeInContact& closed, const NodeInContact& open, double length,
                       double modulus) {
  if (modulus == 0) return .5;
  const double left = 3 * modulus * std::max(0., open.gap), right = 4 * closed.pressure * length;
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double theta = (low + high) / 2;
    (left * mean_root(theta) < right * std::pow(1 - theta, 1.5) ? low : high) = theta;
  }
  return (low + high) / 2;
}

double part_in_contact(const std::array<NodeInContact, 4>& corners, const std::array<double, 4>& lengths,
                       double modulus) {
  static constexpr std::array<std::array<double, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<std::array<double, 2>> polygon;
  double cover = 0;
  int closed = 0;
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    const bool here = corners[i].pressure > 0, there = corners[j].pressure > 0;
    if (here) polygon.push_back(square[i]), cover += corners[i].cover, ++closed;
    if (here == there) continue;
    const double part = here ? part_in_contact(corners[i], corners[j], lengths[i], modulus)
                             : 1 - part_in_contact(corners[j], corners[i], lengths[i], modulus);
    polygon.push_back({square[i][0] + part * (square[j][0] - square[i][0]),
                       square[i][1] + part * (square[j][1] - square[i][1])});
  }
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return closed > 0 ? cover / closed * twice / 2 : 0;
}

double area_in_contact(std::span<const PointInContact> points, const Comm& comm) {
  double force = 0, weighted = 0;
  for (const auto& [p, area] : points) force += p * area, weighted += p * p * area;
  force = comm.sum(force), weighted = comm.sum(weighted);
  if (force == 0) return 0;
  const double least = in_full * weighted / force;
  double sum = 0;
  for (const auto& [p, area] : points) sum += std::min(1., p / least) * area;
  return sum;
}

}  // namespace bulbus::inline contact
