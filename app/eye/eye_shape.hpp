#pragma once
#include <vector>

#include "core/base/parameters.hpp"

namespace bulbus::inline eye {

/// A quantity along the meridian, linear between its points and constant beyond them.
struct MeridianProfile {
  std::vector<double> angle, value;
  double operator()(double degrees) const;
  template <class V>
  void describe(V&& v) {
    v("angle", angle, About{"degrees from the posterior pole, rising"});
    v("value", value, About{"thickness at each angle", Quantity::length});
  }
};

/// The analytic eye, a body of revolution about z (anterior +, origin at the globe's centre). A place on it
/// has a meridian coordinate t in degrees: on the sclera the polar angle from the posterior pole, on the
/// cornea it runs on by the angle about the corneal centre, up to meridian_end() at the apex.
struct EyeShape {
  double sclera_radius = 12, cornea_radius = 7.8, limbus_radius = 5.8;
  double cornea_center = .54, cornea_edge = .70;
  MeridianProfile sclera{{0, 20, 60, 90, 105, 125, 151}, {1, .95, .65, .45, .45, .55, .80}};
  MeridianProfile choroid{{0, 30, 90, 118}, {.25, .22, .17, .15}};
  MeridianProfile retina{{0, 30, 90, 118}, {.25, .22, .15, .12}};
  MeridianProfile ciliary{{118, 124, 134, 138, 140}, {.27, .35, 1.1, 1.9, 1.7}};
  double ora = 118, ciliary_end = 140;
  double lens_diameter = 9.2, lens_thickness = 4, lens_depth = 3, lens_rim = 1.2, lens_front = 1.1;
  double nerve_diameter = 3.3, nerve_length = 8;

  template <class V>
  void describe(V&& v) {
    v("sclera_radius", sclera_radius, About{"outer radius of the sclera", Quantity::length}.positive());
    v("cornea_radius", cornea_radius, About{"anterior radius of the cornea", Quantity::length}.positive());
    v("limbus_radius", limbus_radius,
      About{"distance of the limbus from the axis", Quantity::length}.positive());
    v("cornea_center", cornea_center,
      About{"thickness of the cornea at its centre", Quantity::length}.positive());
    v("cornea_edge", cornea_edge,
      About{"thickness of the cornea towards its edge", Quantity::length}.positive());
    v("sclera", sclera, About{"thickness of the sclera"});
    v("choroid", choroid, About{"thickness of the choroid"});
    v("retina", retina, About{"thickness of the retina"});
    v("ciliary", ciliary, About{"thickness of the ciliary body"});
    v("ora", ora, About{"degrees from the posterior pole at which choroid and retina end"}.between(100, 135));
    v("ciliary_end", ciliary_end, About{"degrees at which the ciliary body ends"}.between(110, 150));
    v("lens_diameter", lens_diameter, About{"diameter of the lens", Quantity::length}.positive());
    v("lens_thickness", lens_thickness, About{"thickness of the lens", Quantity::length}.positive());
    v("lens_depth", lens_depth, About{"anterior pole behind the inner cornea", Quantity::length}.positive());
    v("lens_rim", lens_rim, About{"height of the lens's rim", Quantity::length}.positive());
    v("lens_front", lens_front, About{"height of the lens's anterior cap", Quantity::length}.positive());
    v("nerve_diameter", nerve_diameter, About{"diameter of the optic nerve", Quantity::length}.positive());
    v("nerve_length", nerve_length,
      About{"length of the nerve's stub behind the globe", Quantity::length}.positive());
  }

  /// A point of a meridian half-plane: distance from the axis and height, mm.
  struct Place {
    double rho, z;
  };

  double limbus() const;        ///< t of the limbus, degrees
  double cornea_angle() const;  ///< angle between limbus and apex about the corneal centre, degrees
  double meridian_end() const { return limbus() + cornea_angle(); }
  double nerve_edge() const;  ///< t of the nerve's edge, degrees

  /// The point `depth` under the outer surface, along the column at t (the globe's radius; on the cornea a
  /// direction that turns into its normal at the apex).
  Place place(double t, double depth) const;
  /// Depth of the inner surface of sclera and cornea along that column.
  double wall(double t) const;

  double lens_back() const {
    return lens_thickness - lens_rim - lens_front;
  }                          ///< height of the posterior cap
  double lens_pole() const;  ///< z of the anterior pole
  /// Anterior (top) and posterior surface at a distance from the axis: spherical caps on a rim.
  double lens_top(double rho) const;
  double lens_bottom(double rho) const;

  /// Throws InputError if the parts do not fit together.
  void check() const;
};

}  // namespace bulbus::inline eye
