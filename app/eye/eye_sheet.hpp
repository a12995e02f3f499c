#pragma once
#include <array>
#include <optional>
#include <vector>

#include "app/eye/eye.hpp"
#include "core/mesh/generate/o_grid.hpp"

namespace bulbus::inline eye {

/// The eye's outer surface as the image of a lattice: (i, j) as in the poles' discs, s along the meridian
/// from the posterior disc's core (0) over its rings, the rings of the globe and those of the anterior disc
/// to its core (end()).
class SheetMap {
 public:
  explicit SheetMap(const EyeSettings& settings);
  struct Place {
    double t;     ///< meridian coordinate, degrees
    double x, y;  ///< azimuth: cosines to x and y; x is exactly 0 on the plane of symmetry
  };
  /// i, j and s may lie between the integers.
  Place operator()(double i, double j, double s) const;

  const DiscMap& posterior() const { return posterior_; }
  const DiscMap& anterior() const { return anterior_; }
  /// Rings between the discs; the last one ends on the anterior disc's rim.
  int globe_rings() const { return globe_rings_; }
  int end() const { return posterior_.rings + globe_rings_ + anterior_.rings; }
  /// Does a ring of nodes lie within the band or on its edges?
  bool in_band(int s) const;

 private:
  /// Rings from t = `from` to `to`; each is `growth` times as wide as the one before (at n = 14).
  struct Band {
    double from, to;
    int rings;
    double growth = 1;
    bool halved = false;  ///< an even number of rings at every n: one ends in the middle
    int count = 0;        ///< rings at this n
    double ring_end(double ring) const;
  };
  std::vector<Band> bands(const EyeSettings& settings) const;
  TearLines tear_lines(const EyeSettings& settings) const;
  Place on_lattice(double i, double j, double s) const;

  DiscMap posterior_, anterior_;
  std::vector<Band> bands_;
  int globe_rings_ = 0;
  double nerve_, cornea_, end_, limbus_;  ///< degrees
  std::optional<TearLines> tear_;
};

/// Degrees from 12 o'clock.
double azimuth(const SheetMap::Place& place);

/// The grid of whole lattice points, from pole to pole: a half disc with the nerve's section, rings, a half
/// disc with the cornea. Every node is the head of a column through the layers.
struct EyeSheet {
  struct Node : SheetMap::Place {
    int i, j, s;
  };
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> quads;  ///< normals outwards
  int nerve_nodes = 0, nerve_quads = 0;   ///< the first of each lie under the nerve
  std::vector<int> nerve_ring;            ///< the ring next to the nerve's edge
  int posterior_pole = 0, anterior_pole = 0;

  /// Mean t of a quad's nodes.
  double middle(int quad) const;
};

EyeSheet eye_sheet(const EyeSettings& settings);

/// A count that is `base` at n = 14, in proportion to n, and 1 at least.
int scaled(int base, int n);

}  // namespace bulbus::inline eye
