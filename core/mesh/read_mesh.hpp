#pragma once
#include <string>
#include <vector>

#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

/// Whether a file is read as a VTK grid, whose cell array tells the regions: .vtu or .vtk.
bool is_vtk(const std::string& path);

/// Reads a mesh file: Abaqus (.inp), VTK (.vtu, .vtk; `regions` names the cell array) or, whatever else its
/// name ends in, Gmsh. Throws InputError.
ReadMesh read_mesh(const std::string& path, const std::string& regions = "region");

/// The files that a mesh file includes (*INCLUDE of Abaqus), without itself; as far as they can be read.
std::vector<std::string> included_files(const std::string& path);

}  // namespace bulbus::inline mesh
