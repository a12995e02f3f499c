#pragma once
#include <span>
#include <string>

#include "contact/law/contact_figures.hpp"
#include "contact/rigid/rigid_surface.hpp"
#include "core/problem/problem.hpp"

namespace bulbus::inline contact {

/// The angle that the arcs of a band span, rad. Throws InputError (with `key`) unless `body` is a band whose
/// arcs close radially and span no more than half a turn each.
double band_opening(const RigidBodySpec& body, const std::string& name, const std::string& key);

/// What the drawn model has of a band whose arcs close radially.
struct BandArcs {
  double opening;  ///< the angle that the arcs span, rad
  int widths =
      1;  ///< 2 where a plane of symmetry halves the band's width: its forces are then those of a half
};

/// Throws InputError (with `key`) unless `body` is such a band, on the drawn side of the planes of symmetry
/// that its axis lies in. Collective.
BandArcs band_arcs(const Problem& problem, const RigidSurface& band, const std::string& body,
                   const std::string& key);

/// Hoop force of a band without friction, N, from the forces on its arcs (as drawn, without images):
///     T = −w Σ F_p·d_p / Σ 2 sin h_p,   d_p the direction in which an arc closes where it is now, h_p half
///     of
/// its angle, w the widths: the force that does the work of what presses when the arcs close; p w r under a
/// pressure p on a width w.
double band_tension(const RigidSurface& band, const BandArcs& arcs, std::span<const Wrench> on_arcs);

}  // namespace bulbus::inline contact
