#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// The point of some faces nearest to a target, as weights on one face. Weights within rounding of 0 are 0.
struct Embedding {
  EmbeddedPoint point;
  double distance = 0;  ///< from the target, mm
  double size = 0;      ///< longer diagonal of the face, mm
};

/// Throws std::logic_error if there are no faces.
Embedding embed(const Mesh& mesh, const std::vector<Quad>& faces, const Point& target);

/// Where an embedded point is, mm.
Point position(const Mesh& mesh, const EmbeddedPoint& point);

/// The node that an embedded point sits in, or -1.
int sole_node(const EmbeddedPoint& point);

/// A point that sits in a node.
EmbeddedPoint at_node(int node);

}  // namespace bulbus::inline mesh
