#pragma once
#include <array>

namespace bulbus::inline contact {

/// How a contact leaves a node of its slave surface.
struct NodeInContact {
  double pressure, gap;  ///< MPa, 0: open; mm
};

/// Part of an edge from a node in contact to an open one, `length` mm away, that is in contact. Near the end
/// of a contact of two bodies without friction, at the distances d inside and d' outside (Johnson, Contact
/// Mechanics, 1985, section 5.1),
///     p = K √d,  G = 4/3 K/E* d'^(3/2),  1/E* = Σ (1 − ν²)/E
/// where the node's pressure is the mean over its half edges, and d + d' = length. `modulus`: E*, MPa; 0:
/// half of the edge.
double part_in_contact(const NodeInContact& closed, const NodeInContact& open, double length, double modulus);

/// Part of a face that is in contact: of the polygon of its corners in contact and the ends of contact on its
/// edges. `lengths`: of the edge from each corner to the next, mm.
double part_in_contact(const std::array<NodeInContact, 4>& corners, const std::array<double, 4>& lengths,
                       double modulus);

}  // namespace bulbus::inline contact
