#pragma once
#include <string>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Reads a Gmsh file, MSH 2.2 or 4.1, ASCII or binary.
///
/// - 8-node hexahedra; the physical group of dimension 3 names the region ("region_TAG" if it has no name).
/// Cells that
///   are inside out are turned.
/// - Quads in physical groups of dimension 2 become surfaces, with normals out of their hexahedron (out of
/// the first of two
///   if the quad lies between two).
/// - 2-node lines in physical groups of dimension 1 become bars. An end that is no node of a hexahedron must
/// lie on the
///   boundary and is embedded there. A group "NAME share=0.5" belongs to the bars NAME, with that share.
/// - Points in physical groups of dimension 0 become node sets.
///
/// Groups of one name and dimension are collected, lines, quads and points without a group are ignored, and
/// nodes that no hexahedron uses are dropped. Anything else throws InputError with file and line (binary: the
/// element's number).
Mesh read_gmsh(const std::string& path);

/// How a file is written.
struct GmshFormat {
  bool version4 = true;  ///< MSH 4.1, otherwise 2.2
  bool binary = true;
};

/// Writes regions, surfaces, node sets and bars as physical groups, so that read_gmsh gives the same mesh
/// again (but for the numbering of nodes; ends of bars within a face are extra nodes in the file). A
/// hexahedral face that several surfaces share is written once for each. Throws InputError if the file cannot
/// be written.
void write_gmsh(const Mesh& mesh, const std::string& path, const GmshFormat& format = {});

}  // namespace bulbus::inline mesh
