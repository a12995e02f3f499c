#pragma once
#include <string>
#include <vector>

#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus::inline app {

/// A table of all surfaces, their faces and areas; empty if there are none. Collective.
std::vector<std::string> surface_lines(const LocalMesh& mesh);

/// A table of all node sets and their sizes; empty if there are none. Collective.
std::vector<std::string> set_lines(const LocalMesh& mesh);

/// Cells of a scaled Jacobian below 0.1, worst first; empty if there are none. Collective.
std::vector<std::string> poor_cell_lines(const LocalMesh& mesh);

}  // namespace bulbus::inline app
