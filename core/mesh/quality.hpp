#pragma once
#include <string>
#include <vector>

#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus {

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

/// Throws InputError naming the worst cell whose scaled Jacobian is not positive, its region and its centre,
/// and the numbers of others.
void refuse_inverted(const Mesh& mesh);
/// The same, on every rank. Collective.
void refuse_inverted(const LocalMesh& mesh);

}  // namespace bulbus
