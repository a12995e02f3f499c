#pragma once
#include <string>

#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

/// Reads the mesh of an Abaqus or CalculiX input file, and of the files that it includes.
///
/// - *ELEMENT of type C3D8 and its variants (C3D8R, C3D8H, C3D8I, ...): hexahedra. Cells that are inside out
/// are turned.
/// - *SOLID SECTION: its ELSET is a region. Without any section the ELSET of the *ELEMENT lines are the
/// regions.
/// - *NSET, and *SURFACE of type NODE: node sets, less the nodes that no hexahedron uses.
/// - *SURFACE of type ELEMENT: surfaces, normals out of the elements that it names; without a face, the outer
/// faces of those elements.
/// - *PART, *INSTANCE (with translation and rotation), *ASSEMBLY. Names of a part are `INSTANCE.NAME` where
/// the file has several instances, or the assembly has the same name.
///
/// Names are compared without regard to case and kept as they are first spelt. The notes tell which keywords
/// were skipped, a warning which of them are constraints. Throws InputError with file and line.
ReadMesh read_abaqus(const std::string& path);

}  // namespace bulbus::inline mesh
