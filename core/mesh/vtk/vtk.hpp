#pragma once
#include <string>

#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

/// Reads an unstructured grid of hexahedra (cell types 12 and 11, voxels): an XML file (.vtu: ASCII, base64
/// or raw, inline or appended, zlib) or a legacy file (.vtk: ASCII or binary), as its content says.
///
/// - The cell array `regions` holds whole numbers: they name the regions, `1`, `2`, ... A file without such
/// an array and without any other of whole numbers is one region, `1`. Cells that are inside out are turned.
/// - Point arrays of whole numbers that are all 0 or 1 are node sets: the points with 1.
/// - There are no surfaces in such files. `boundary` is all outer faces; with several regions, `A/boundary`
/// are those of region A and `A/B` the faces between A and B, A before B in the list of regions, normals out
/// of A.
///
/// The notes tell which arrays were skipped. Throws InputError with the file and, in text, the line.
ReadMesh read_vtk(const std::string& path, const std::string& regions = "region");

}  // namespace bulbus::inline mesh
