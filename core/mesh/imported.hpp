#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// A mesh from a file.
struct ReadMesh {
  Mesh mesh;
  std::vector<std::string> notes;     ///< on what of the file was left out
  std::vector<std::string> warnings;  ///< on what was left out and makes another body of the mesh
};

/// How many cells of a file are no 8-node hexahedra, by their kind ("tetrahedra").
using OtherCells = std::map<std::string, long long>;

/// "3 of 40 cells are no 8-node hexahedra: 1 pyramids, 2 tetrahedra".
std::string other_cells_text(const OtherCells& others, long long hexahedra);

/// Refuses a file with such cells; `line` is that of the first one, or 0.
[[noreturn]] void refuse_other_cells(const std::string& path, int line, const OtherCells& others,
                                     long long hexahedra, const std::string& remedy);

/// Drops the points that no hexahedron uses and keeps the order of the others. Returns the new number of
/// every old point, −1 where it is gone.
std::vector<int> drop_unused_points(Mesh& mesh);

/// Turns hexahedra of negative volume: what was below is above then (local faces 0 and 1 are exchanged, the
/// others keep their number). Returns which ones.
std::vector<bool> turn_inverted(Mesh& mesh);

}  // namespace bulbus::inline mesh
