#include "core/mesh/eye_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/o_grid.hpp"

namespace bulbus {
namespace {

/// Rings from t = `from` to `to`; each is `growth` times as wide as the one before (at n = 14).
struct Band {
  double from, to;
  int rings;
  double growth = 1;
};

std::vector<Band> bands(const EyeSettings& s) {
  const EyeShape& e = s.shape;
  const double half = std::asin(s.band_half_width / e.sclera_radius) * 180 / std::numbers::pi;
  const double lower = 90 - half, upper = 90 + half, span = e.ciliary_end - e.ora;
  if (!(lower > 55 && upper < e.ora))
    throw input_error("eye: the band does not fit between 55 degrees and the ora",
                      "give a smaller band_half_width");
  // The ciliary body's rings meet the corners of its default profile.
  return {{e.nerve_edge(), 48, 6, 1.15},
          {48, lower, 5, .85},
          {lower, upper, 4},
          {upper, e.ora, 4, 1.15},
          {e.ora, e.ora + 3 * span / 11, 1},
          {e.ora + 3 * span / 11, e.ora + 8 * span / 11, 2},
          {e.ora + 8 * span / 11, e.ora + 10 * span / 11, 1},
          {e.ora + 10 * span / 11, e.ciliary_end, 1},
          {e.ciliary_end, e.limbus(), 2}};
}

/// End of ring i of m; exact at i = m.
double ring_end(const Band& b, int i, int m) {
  if (i == m) return b.to;
  const double s = static_cast<double>(i) / m;
  if (b.growth == 1) return b.from + s * (b.to - b.from);
  const double g = std::pow(b.growth, b.rings);
  return b.from + (b.to - b.from) * (std::pow(g, s) - 1) / (g - 1);
}

/// The circles of nodes between the two discs, their own rims left out.
std::vector<double> circles(const EyeSettings& s) {
  std::vector<double> t;
  for (const Band& b : bands(s)) {
    const int m = scaled(b.rings, s.n);
    for (int i = 1; i <= m; ++i) t.push_back(ring_end(b, i, m));
  }
  t.pop_back();
  return t;
}

/// Adds a disc's nodes (`t` of the disc radius) and quads; returns its rim.
template <class Meridian>
std::vector<int> add_disc(EyeSheet& sheet, const Disc& disc, bool flip, int& pole, Meridian&& t) {
  const int first = static_cast<int>(sheet.nodes.size());
  for (const Disc::Node& d : disc.nodes) {
    if (d.radius == 0) pole = static_cast<int>(sheet.nodes.size());
    sheet.nodes.push_back({t(d.radius), d.x, d.y});
  }
  for (std::array<int, 4> q : disc.quads) {
    if (flip) std::swap(q[1], q[3]);
    for (int& k : q) k += first;
    sheet.quads.push_back(q);
  }
  std::vector<int> rim = disc.rim;
  for (int& k : rim) k += first;
  return rim;
}

void add_ring(EyeSheet& sheet, const std::vector<int>& behind, const std::vector<int>& ahead) {
  for (std::size_t k = 0; k + 1 < behind.size(); ++k)
    sheet.quads.push_back({behind[k], ahead[k], ahead[k + 1], behind[k + 1]});
}

}  // namespace

int scaled(int base, int n) { return std::max(1, static_cast<int>(std::lround(base * n / 14.0))); }

double EyeSheet::middle(int quad) const {
  double sum = 0;
  for (int k : quads[quad]) sum += nodes[k].t;
  return sum / 4;
}

EyeSheet eye_sheet(const EyeSettings& s) {
  if (s.n < 4 || s.n % 2)
    throw input_error("eye: n = " + std::to_string(s.n) + " is not an even number of at least 4",
                      "give n = 8, 14, 28, ...");
  EyeSheet sheet;
  const EyeShape& e = s.shape;
  const double nerve = e.nerve_edge(), cornea = e.cornea_angle(), end = e.meridian_end(), limbus = e.limbus();

  std::vector<int> rim = add_disc(sheet, o_grid(s.n / 2, scaled(1, s.n), .68, true), true,
                                  sheet.posterior_pole, [&](double r) { return r * nerve; });
  sheet.nerve_nodes = static_cast<int>(sheet.nodes.size());
  sheet.nerve_quads = static_cast<int>(sheet.quads.size());
  for (double t : circles(s)) {
    std::vector<int> next;
    for (int k : rim) {
      next.push_back(static_cast<int>(sheet.nodes.size()));
      sheet.nodes.push_back({t, sheet.nodes[k].x, sheet.nodes[k].y});
    }
    add_ring(sheet, rim, next);
    rim = next;
    if (sheet.nerve_ring.empty()) sheet.nerve_ring = rim;
  }
  const std::vector<int> front =
      add_disc(sheet, o_grid(s.n / 2, scaled(4, s.n), .5, true), false, sheet.anterior_pole,
               [&](double r) { return r == 1 ? limbus : end - r * cornea; });
  add_ring(sheet, rim, front);
  return sheet;
}

}  // namespace bulbus
