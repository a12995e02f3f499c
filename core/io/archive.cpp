#include "core/io/archive.hpp"

#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus::inline io {

Archive::Archive(const LocalMesh& mesh) {
  for (int n = 0; n < mesh.nodes(); ++n) nodes_.add(mesh.input_node[n], n < mesh.owned);
  for (int h : mesh.input_hex) hexes_.add(h, true);
}

}  // namespace bulbus::inline io
