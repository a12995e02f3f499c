#pragma once
#include <array>
#include <span>

#include "core/base/parallel.hpp"

namespace bulbus::inline contact {

/// How a contact leaves a node of its slave surface.
struct NodeInContact {
  double pressure, gap;  ///< MPa, 0: open; mm
  double cover = 1;      ///< φ: the part of the node that lies on the master
};

/// Part of an edge from a node in contact to an open one, `length` mm away, that is in contact. Near the end
/// of a contact of two bodies without friction, at the distances d inside and d' outside (Johnson, Contact
/// Mechanics, 1985, section 5.1),
///     p = K √d,  G = 4/3 K/E* d'^(3/2),  1/E* = Σ (1 − ν²)/E
/// where the node's pressure is the mean over its half edges, and d + d' = length. `modulus`: E*, MPa; 0:
/// half of the edge.
double part_in_contact(const NodeInContact& closed, const NodeInContact& open, double length, double modulus);

/// Part of a face that is in contact: of the polygon of its corners in contact and the ends of contact on its
/// edges, by the mean φ of those corners. `lengths`: of the edge from each corner to the next, mm.
double part_in_contact(const std::array<NodeInContact, 4>& corners, const std::array<double, 4>& lengths,
                       double modulus);

/// A slave point in contact.
struct PointInContact {
  double pressure, area;  ///< MPa, mm²
};

/// Area of points on faces that is in contact on this rank, mm². A point counts in proportion to its pressure
/// up to a hundredth of the mean that the force is carried with, P = Σ p² A / Σ p A over all ranks, and in
/// full above: the area is continuous where a point begins to touch, and Hertz' pressure is below P / 100 on
/// 6e-5 of his area alone. Collective.
double area_in_contact(std::span<const PointInContact> points, const Comm& comm);

}  // namespace bulbus::inline contact
