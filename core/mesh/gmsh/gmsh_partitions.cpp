// $PartitionedEntities of MSH 4.1: the parts into which Gmsh has cut the entities of a partitioned mesh.
#include <set>

#include "core/mesh/gmsh/gmsh_file.hpp"

namespace bulbus::inline mesh {
namespace {

// Gmsh adds groups of its own, such as _part{1}_physical{2}.
bool made_by_partitioning(const GmshFile& file, int dimension, int tag) {
  const auto name = file.names.find({dimension, tag});
  return name != file.names.end() && name->second.starts_with("_part{");
}

std::set<int> read_parts(GmshScanner& in, bool b) {
  std::set<int> parts;
  for (long long n = in.count(b); n > 0; --n) parts.insert(in.whole(b));
  return parts;
}

}  // namespace

void read_partitioned4(GmshScanner& in, const GmshFile& file, GmshEntities& entities) {
  const bool b = file.binary;
  const long long parts = in.count(b);
  for (long long ghosts = in.count(b); ghosts > 0; --ghosts) in.whole(b), in.whole(b);  // entity, part
  std::set<int> with_volumes;
  long long counts[4];
  for (long long& c : counts) c = in.count(b);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (long long n = 0; n < counts[dimension]; ++n) {
      const int tag = in.whole(b), parent_dimension = in.whole(b), parent = in.whole(b);
      const std::set<int> of = read_parts(in, b);
      if (dimension == 3) with_volumes.insert(of.begin(), of.end());
      std::vector<int> groups = read_entity4(in, b, dimension);
      std::erase_if(groups, [&](int g) { return made_by_partitioning(file, dimension, g); });
      // an interface between parts has a parent of higher dimension, whose groups are not its own
      if (groups.empty() && parent_dimension == dimension) groups = entities[{dimension, parent}];
      entities[{dimension, tag}] = groups;
    }
  if (static_cast<long long>(with_volumes.size()) != parts)
    in.fail("the mesh is partitioned, and the file has volumes of " + std::to_string(with_volumes.size()) +
                " of its " + std::to_string(parts) + " parts",
            "save all parts in one file (Mesh.PartitionSplitMeshFiles = 0 in Gmsh), or the mesh without "
            "partitions");
}

}  // namespace bulbus::inline mesh
