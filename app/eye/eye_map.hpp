#pragma once
#include "app/eye/eye_sheet.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline eye {

/// The analytic half eye as the image of a lattice. A node's parameters are (i, j, s, level, part) in the
/// coats and the nerve: the column under the sheet's (i, j, s) and the level in it; and (i, j, ring, layer,
/// part) in the lens.
///
/// Levels: 0 is the outer surface, `wall` the inner surface of sclera and cornea, `choroid` that of the
/// choroid, `inner` that of the retina and the ciliary body. Below 0: the nerve, whose end is −`nerve`.
class EyeMap {
 public:
  /// What the fifth parameter says. Between an attached and a lifted node it lies between them, and that node
  /// is lifted.
  static constexpr double lens = -1, attached = 0, lifted = 1;

  explicit EyeMap(const EyeSettings& settings);
  Point operator()(const Parameters& p) const;
  /// Does a ring of the sheet follow the band, edges included?
  bool in_band(int s) const { return sheet_.in_band(s); }

  const int scale, wall, choroid, inner, nerve;
  const int lens_layers;
  const DiscMap lens_disc;

 private:
  double depth(double t, double level) const;
  Point lens_place(const Parameters& p) const;
  Point under(const SheetMap::Place& column, double depth) const;

  EyeShape shape_;
  SheetMap sheet_;
  std::optional<Detachment> detachment_;
};

}  // namespace bulbus::inline eye
