#pragma once
#include <span>
#include <utility>
#include <vector>

namespace bulbus::inline eye {

/// Degrees: from the posterior pole, and from 12 o'clock.
struct TearEdges {
  double back, front, side;
};

/// Moves the lines of the eye's lattice that lie nearest to a tear's edges onto them, and those around the
/// less the farther they are, so that a tear of whole cells has its edges where they are asked for.
class TearLines {
 public:
  /// `rings`: the lattice's rings under the retina, whose first and last stay where they are, as does that at
  /// `pinned` degrees; `columns`: its azimuths from 0. Nothing moves where cells would have to become less
  /// than 0.4 or more than 2.5 times as long as they were.
  TearLines(const TearEdges& edges, std::span<const double> rings, double pinned,
            std::span<const double> columns);
  /// Where a place (t, azimuth) comes to lie, degrees.
  std::pair<double, double> operator()(double t, double azimuth) const;

 private:
  // A function that is linear between its knots and constant beyond them.
  using Knots = std::vector<std::pair<double, double>>;
  Knots shift_t_, shift_azimuth_;    // of the lines; no ring: nothing moves
  Knots weight_t_, weight_azimuth_;  // of the shift of the other kind of lines, across them
};

}  // namespace bulbus::inline eye
