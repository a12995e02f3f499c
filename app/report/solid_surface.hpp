#pragma once
#include <span>
#include <vector>

#include "core/io/vtkhdf_read.hpp"

namespace bulbus::inline app {

/// A face that is drawn, its nodes in turn with the normal out of its cell.
struct ShownFace {
  Quad nodes;
  int cell;
  int other = -1;  ///< region on its far side, -1: none
};

/// What a page shows of the solid. Nodes and cells are counted from 0; `nodes` and `cells` are their numbers
/// in the files.
struct ShownSolid {
  std::vector<int> nodes, cells;
  std::vector<int> regions;  ///< per cell
  std::vector<ShownFace> faces;
  std::vector<Hex> hexes;  ///< per cell, to be cut; none where the surfaces alone are shown
};

/// Makes the nodes that stand at the same place in two pieces one, the first: `apart` (`width` numbers per
/// node) tells those apart that only begin at the same place. Meshes of one piece stay as they are.
void join_pieces(SavedMesh& mesh, std::span<const double> apart, std::size_t width);

/// The whole solid, with the faces of one cell and those between two regions, which are there once for each.
ShownSolid whole_solid(const SavedMesh& mesh, std::span<const int> regions);

/// Without cells and nodes that no face shows.
ShownSolid surface_of(const ShownSolid& solid);

/// Surfaces whose nodes in the same cube of that width (mm) are one, without the faces that vanish.
ShownSolid clustered(const ShownSolid& surface, std::span<const Point> points, double width);

}  // namespace bulbus::inline app
