#include "app/eye/eye_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "app/eye/degree.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline eye {
namespace {

constexpr double equator = 90;

/// Adds a disc's nodes (s of the disc's ring) and quads; returns its rim.
template <class Level>
std::vector<int> add_disc(EyeSheet& sheet, const SheetMap& map, const Disc& disc, bool flip, int& pole,
                          Level&& s) {
  const int first = static_cast<int>(sheet.nodes.size());
  for (const Disc::Node& d : disc.nodes) {
    if (d.radius == 0) pole = static_cast<int>(sheet.nodes.size());
    sheet.nodes.push_back({map(d.i, d.j, s(d.ring)), d.i, d.j, s(d.ring)});
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

std::vector<SheetMap::Band> SheetMap::bands(const EyeSettings& s) const {
  const EyeShape& e = s.shape;
  const double half = std::asin(s.band_half_width / e.sclera_radius) / degree;
  const double lower = equator - half, upper = equator + half, span = e.ciliary_end - e.ora;
  if (!(lower > 55 && upper < e.ora))
    throw input_error("eye: the band does not fit between 55 degrees and the ora",
                      "give a smaller band_half_width");
  // The ciliary body's rings meet the corners of its default profile.
  return {{nerve_, 48, 6, 1.15},
          {48, lower, 5, .85},
          {lower, upper, 4, 1, true},  // the equator is a ring of nodes
          {upper, e.ora, 4, 1.15},
          {e.ora, e.ora + 3 * span / 11, 1},
          {e.ora + 3 * span / 11, e.ora + 8 * span / 11, 2},
          {e.ora + 8 * span / 11, e.ora + 10 * span / 11, 1},
          {e.ora + 10 * span / 11, e.ciliary_end, 1},
          {e.ciliary_end, limbus_, 2}};
}

double SheetMap::Band::ring_end(double ring) const {
  if (ring == count) return to;
  const double part = ring / count;
  if (growth == 1) return from + part * (to - from);
  const double g = std::pow(growth, rings);
  return from + (to - from) * (std::pow(g, part) - 1) / (g - 1);
}

SheetMap::SheetMap(const EyeSettings& s)
    : posterior_{s.n / 2, scaled(1, s.n), .68},
      anterior_{s.n / 2, scaled(4, s.n), .5},
      nerve_(s.shape.nerve_edge()),
      cornea_(s.shape.cornea_angle()),
      end_(s.shape.meridian_end()),
      limbus_(s.shape.limbus()) {
  bands_ = bands(s);
  for (Band& b : bands_)
    globe_rings_ += b.count = b.halved ? 2 * scaled(b.rings / 2, s.n) : scaled(b.rings, s.n);
  if (s.detachment && s.detachment->tear) tear_ = tear_lines(s);
}

// The rings under the retina end at the ora, where other tissue begins.
TearLines SheetMap::tear_lines(const EyeSettings& s) const {
  std::vector<double> rings{nerve_}, columns;
  for (const Band& b : bands_)
    for (int ring = 1; b.to <= s.shape.ora && ring <= b.count; ++ring) rings.push_back(b.ring_end(ring));
  for (const Disc disc = o_grid(posterior_, true); int k : disc.rim)
    columns.push_back(std::atan2(disc.nodes[k].x, disc.nodes[k].y) / degree);
  return {edges_of(*s.detachment->tear, s.shape), rings, equator, columns};
}

SheetMap::Place SheetMap::operator()(double i, double j, double s) const {
  const Place p = on_lattice(i, j, s);
  if (!tear_) return p;
  const double before = azimuth(p);
  const auto [t, after] = (*tear_)(p.t, before);
  if (after == before) return {t, p.x, p.y};
  return {t, std::sin(after * degree), std::cos(after * degree)};
}

bool SheetMap::in_band(int s) const {
  int first = posterior_.rings;
  auto band = bands_.begin();
  for (; !band->halved; ++band) first += band->count;  // the one with the equator in its middle
  return s >= first && s <= first + band->count;
}

SheetMap::Place SheetMap::on_lattice(double i, double j, double s) const {
  const double globe = s - posterior_.rings, front = globe - globe_rings_;
  if (globe <= 0) {
    const DiscMap::Place d = posterior_(i, j, s);
    return {d.radius * nerve_, d.x, d.y};
  }
  if (front > 0) {
    const DiscMap::Place d = anterior_(i, j, anterior_.rings - front);
    return {end_ - d.radius * cornea_, d.x, d.y};
  }
  double ring = globe;
  auto band = bands_.begin();
  while (ring > band->count) ring -= (band++)->count;
  const DiscMap::Place d = posterior_(i, j, posterior_.rings);
  return {band->ring_end(ring), d.x, d.y};
}

double EyeSheet::middle(int quad) const {
  double sum = 0;
  for (int k : quads[quad]) sum += nodes[k].t;
  return sum / 4;
}

EyeSheet eye_sheet(const EyeSettings& settings) {
  if (settings.n < 4 || settings.n % 2)
    throw input_error("eye: n = " + std::to_string(settings.n) + " is not an even number of at least 4",
                      "give n = 8, 14, 28, ...");
  EyeSheet sheet;
  const SheetMap map(settings);

  std::vector<int> rim = add_disc(sheet, map, o_grid(map.posterior(), true), true, sheet.posterior_pole,
                                  [](int ring) { return ring; });
  sheet.nerve_nodes = static_cast<int>(sheet.nodes.size());
  sheet.nerve_quads = static_cast<int>(sheet.quads.size());
  for (int ring = 1; ring < map.globe_rings(); ++ring) {
    std::vector<int> next;
    for (int k : rim) {
      const int i = sheet.nodes[k].i, j = sheet.nodes[k].j, s = map.posterior().rings + ring;
      next.push_back(static_cast<int>(sheet.nodes.size()));
      sheet.nodes.push_back({map(i, j, s), i, j, s});
    }
    add_ring(sheet, rim, next);
    rim = next;
    if (sheet.nerve_ring.empty()) sheet.nerve_ring = rim;
  }
  const std::vector<int> front = add_disc(sheet, map, o_grid(map.anterior(), true), false,
                                          sheet.anterior_pole, [&](int ring) { return map.end() - ring; });
  add_ring(sheet, rim, front);
  return sheet;
}

}  // namespace bulbus::inline eye
