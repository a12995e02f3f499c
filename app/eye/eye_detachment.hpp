#pragma once
#include <optional>

#include "app/eye/tear_lines.hpp"
#include "core/base/parameters.hpp"

namespace bulbus::inline eye {

/// A hole in the detached retina on the plane x = 0, at 12 o'clock; sizes are those of the whole eye, along
/// the retina's bed through its center. Cells are moved until their edges are the tear's (TearLines); where
/// they would be drawn out too far, it is made of those with their centre within, one at least.
struct Tear {
  double center = 90, width = 2.6, length = 2;
  template <class V>
  void describe(V&& v) {
    v("center", center, About{"degrees from the posterior pole"}.between(0, 180));
    v("width", width, About{"across the meridian; the half eye has half of it", Quantity::length}.positive());
    v("length", length, About{"along the meridian", Quantity::length}.positive());
  }
};

struct EyeShape;
/// Where a tear's edges lie. Throws InputError where it has no size.
TearEdges edges_of(const Tear& tear, const EyeShape& shape);

/// Retina lifted off the choroid towards the vitreous, about the azimuth of 12 o'clock: shifted along the
/// globe's radius, on which it keeps its thickness.
struct Detachment {
  double center = 88, half_length = 30, half_width = 50, height = 1.25;
  std::optional<Tear> tear;
  template <class V>
  void describe(V&& v) {
    v("center", center, About{"degrees from the posterior pole"}.between(0, 180));
    v("half_length", half_length, About{"half extent along the meridian, degrees"}.between(1, 90));
    v("half_width", half_width, About{"half extent in azimuth, degrees"}.between(1, 180));
    v("height", height, About{"lift of the retina at the center", Quantity::length}.positive());
    v("tear", tear, About{"a hole in the detached retina, on the plane of symmetry"});
  }

  /// height (1 − q)², q = ((t − center) / half_length)² + (azimuth / half_width)², degrees; 0 where q >= 1.
  double lift(double t, double azimuth) const;
};

}  // namespace bulbus::inline eye
