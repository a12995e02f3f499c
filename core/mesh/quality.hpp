#pragma once
#include <string>
#include <vector>

#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus::inline mesh {

/// Least over the eight corners of det(e1, e2, e3) / (|e1| |e2| |e3|), e the three edges at the corner: 1 for
/// a cuboid, 0 or less for a cell that is no hexahedron any more.
double scaled_jacobian(const Mesh& mesh, int hex);

/// Quality of the cells of one region.
struct RegionQuality {
  std::string region;
  int count = 0;
  double volume = 0;        ///< mm³
  double least = 1;         ///< scaled Jacobian
  double five_percent = 1;  ///< the value that 5 % of the cells are below
  double mean = 1;
};

/// One entry per region, in the order of region_names.
std::vector<RegionQuality> quality(const Mesh& mesh);
/// Of all ranks, the same on each. Collective.
std::vector<RegionQuality> quality(const LocalMesh& mesh);

/// A hexahedron, its scaled Jacobian (one that is not a number counts as −2), its number in the Mesh, region
/// and centre (mm).
struct PoorCell {
  double quality;
  int number, region;
  Point center;
};

/// Hexahedra of which the scaled Jacobian is not above a limit.
struct PoorCells {
  static constexpr std::size_t most_listed = 50;
  long long count = 0;          ///< of all ranks
  std::vector<PoorCell> worst;  ///< the first `most_listed`, worst first, then by number
};
/// The same on every rank. Collective.
PoorCells poor_cells(const LocalMesh& mesh, double limit);

/// Throws InputError naming the worst cell whose scaled Jacobian is not positive, its region and its centre,
/// and the numbers of others.
void refuse_inverted(const Mesh& mesh);
/// The same, on every rank. Collective.
void refuse_inverted(const LocalMesh& mesh);

}  // namespace bulbus::inline mesh
