#pragma once
#include <optional>

#include "app/eye/eye_detachment.hpp"
#include "app/eye/eye_shape.hpp"
#include "core/base/parameters.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline eye {

/// Zonules of the half eye: an equatorial row with a bar at both ends on the plane x = 0 (there with share
/// ½), an anterior and a posterior row between. Their ends are places of the analytic eye, so they do not
/// depend on the mesh.
struct ZonuleLayout {
  int equatorial = 81, anterior = 80, posterior = 80;
  double equatorial_from = 138.5, anterior_from = 139.5, posterior_from = 137;
  double anterior_inset = .5, posterior_inset = .8;
  template <class V>
  void describe(V&& v) {
    v("equatorial", equatorial, About{"bars of the equatorial row in the half eye"}.between(2, 100000));
    v("anterior", anterior, About{"bars of the anterior row"}.between(0, 100000));
    v("posterior", posterior, About{"bars of the posterior row"}.between(0, 100000));
    v("equatorial_from", equatorial_from, About{"degrees at which the row leaves the ciliary body"});
    v("anterior_from", anterior_from, About{"degrees at which the row leaves the ciliary body"});
    v("posterior_from", posterior_from, About{"degrees at which the row leaves the ciliary body"});
    v("anterior_inset", anterior_inset,
      About{"distance of the row from the rim on the lens", Quantity::length}.at_least(0));
    v("posterior_inset", posterior_inset,
      About{"distance of the row from the rim on the lens", Quantity::length}.at_least(0));
  }
};

/// The half eye x >= 0 and its mesh.
struct EyeSettings {
  EyeShape shape;
  int n = 14, layers = 1;
  double band_half_width = 1;
  ZonuleLayout zonules;
  std::optional<Detachment> detachment;
  template <class V>
  void describe(V&& v) {
    v("shape", shape, About{"the eye"});
    v("n", n,
      About{"cells across a pole's core, even: 14 gives 7,350 hexahedra, 28 eight times as many"}.between(
          4, 200));
    v("layers", layers,
      About{"times as many cells through the thickness of the wall's coats"}.between(1, 100));
    v("band_half_width", band_half_width,
      About{"rings end at this distance from the equator plane, so that they follow the band",
            Quantity::length}
          .between(.1, 6));
    v("zonules", zonules, About{"fibres that hold the lens"});
    v("detachment", detachment, About{"retina lifted off the choroid"});
  }
};

/// Regions "cornea", "sclera", "ciliary_body", "choroid", "retina", "optic_nerve", "lens".
///
/// Surfaces, normals out of the solid. These four make up the boundary: "cavity" (what the liquid touches;
/// closed but for the plane x = 0), "outside", "nerve_end", "symmetry" (x = 0). Parts of them:
/// "outer_sclera", "outer_cornea", "nerve_side", "inner_retina", "lens_surface".
///
/// A detachment adds to "cavity" both sides of the detached retina, the tear's edge and the choroid under
/// them, and names "retina_back" (the detached retina's outer side) and "retina_bed" (the choroid's inner
/// side under it and under the tear). Where the retina is attached again, the two share their nodes.
///
/// Node sets: "apex" (the cornea's anterior pole), "retina_pole" (the retina's, inside), "nerve_ring" (outer
/// sclera, the ring next to the nerve's edge), "equator_band" (outer sclera, |z| <= band_half_width, but
/// where its edges follow those of a tear), "equator" (outer sclera, z = 0), "nerve_end". With a detachment:
/// "detached" (nodes of "retina_back" that are free of the choroid) and "detached_bed" (the choroid's nodes
/// they came off, in the same order; both rise); with a tear: "tear_rim" (of "detached", those on the tear's
/// edge), "tear_bed_front" and "tear_bed_back" (the choroid's nodes under the tear's front and back edges).
///
/// Bars "zonules". Throws InputError if the settings do not fit together.
Mesh generate(const EyeSettings& settings);

/// A sentence where the detachment's tear, which is made of whole cells, is more than a fifth wider,
/// narrower, longer or shorter than asked for; empty otherwise.
std::string unlike_tear(const EyeSettings& settings);

}  // namespace bulbus::inline eye
