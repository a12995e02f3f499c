#pragma once
#include "app/export/export_file.hpp"
#include "app/export/inp_names.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline app {

/// Names of a mesh in an input file.
struct InpMeshNames {
  InpNames regions, sets, surfaces;
  InpMeshNames(const Mesh& mesh, const std::map<std::string, std::vector<int>>& sets,
               std::vector<std::string>& notes);
};

/// Nodes and elements under their numbers from 1 on, an element set per region, node sets, surfaces.
/// Throws InputError for a surface with a quadrilateral that is no face of a hexahedron.
void write_inp_mesh(ExportFile& out, const Mesh& mesh, const std::map<std::string, std::vector<int>>& sets,
                    const InpMeshNames& names, const std::string& element);

}  // namespace bulbus::inline app
