#pragma once
#include <span>
#include <string>

#include "contact/rigid/rigid_surface.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// The surface of a rigid body as drawn: normals out, closed but for planes, arcs without caps, where
/// one part of an arc meets the next, and open surfaces of Gmsh files. `key` is the path of the spec in the
/// scene ("rigid_bodies.tire"). Throws InputError, among others if the body is inside out.
///
/// The ends of a band and of a tire are rounded as their edges are. An end of an arc in one of the planes of
/// symmetry ("x", ...) stays open, since the body goes on as its image.
RigidSurface make_rigid_surface(const std::string& name, const RigidBodySpec& spec, const std::string& key,
                                std::span<const std::string> symmetry = {});

}  // namespace bulbus::inline contact
