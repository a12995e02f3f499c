#pragma once
#include <string>
#include <vector>

#include "core/io/vtkhdf.hpp"

namespace bulbus::inline io {

/// The mesh of a state that write_vtkhdf saved: its pieces one behind the other, so that nodes between two
/// ranks appear twice.
struct SavedMesh {
  std::vector<Point> points;  ///< reference positions, mm
  std::vector<Hex> hexes;
  std::vector<Label> labels;
  int pieces = 1;
};

/// Throws std::runtime_error if the file is missing, damaged or of other cells. Not collective.
SavedMesh read_vtkhdf_mesh(const std::string& path);

}  // namespace bulbus::inline io
