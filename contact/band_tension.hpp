#pragma once
#include <span>
#include <string>

#include "contact/law/contact_figures.hpp"
#include "contact/rigid/rigid_surface.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// The angle that the arcs of a band span, rad. Throws InputError (with `key`) unless `body` is a band whose
/// arcs close radially.
double band_opening(const RigidBodySpec& body, const std::string& name, const std::string& key);

/// Hoop force of a band without friction, N, from the forces on its arcs (as drawn, without images):
///     T = −Σ F_p·d_p / φ,   d_p the direction in which an arc closes where it is now, φ the opening
/// the force that does the work of what presses when the radius changes; p w r under a pressure p on a width
/// w.
double band_tension(const RigidSurface& band, double opening, std::span<const Wrench> on_arcs);

}  // namespace bulbus::inline contact
