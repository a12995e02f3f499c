#include "core/mesh/gmsh/gmsh_file.hpp"

namespace bulbus::inline mesh {

std::vector<int> read_entity4(GmshScanner& in, bool b, int dimension) {
  for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) in.real(b);  // place, or bounding box
  std::vector<int> groups;
  for (long long n = in.count(b); n > 0; --n) groups.push_back(in.whole(b));
  if (dimension > 0)
    for (long long n = in.count(b); n > 0; --n) in.whole(b);  // bounding entities
  return groups;
}

GmshEntities read_entities4(GmshScanner& in, const GmshFile& file) {
  const bool b = file.binary;
  GmshEntities entities;
  long long counts[4];
  for (long long& c : counts) c = in.count(b);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (long long n = 0; n < counts[dimension]; ++n) {
      const int tag = in.whole(b);
      entities[{dimension, tag}] = read_entity4(in, b, dimension);
    }
  return entities;
}

void read_nodes4(GmshScanner& in, GmshFile& file) {
  const bool b = file.binary;
  const long long blocks = in.count(b);
  for (int i = 0; i < 3; ++i) in.number<std::size_t>(b);  // number of nodes, least and greatest tag
  std::vector<long long> tags;
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = in.whole(b);
    in.whole(b);
    const bool parametric = in.whole(b) != 0;
    tags.clear();
    for (long long n = in.count(b); n > 0; --n) tags.push_back(in.number<std::size_t>(b));
    for (long long t : tags) {
      Point p;
      for (double& x : p) x = in.real(b);
      for (int i = 0; parametric && i < dimension; ++i) in.real(b);
      file.add_node(in, t, p);
    }
  }
}

void read_elements4(GmshScanner& in, GmshFile& file, const GmshEntities& entities) {
  const bool b = file.binary;
  const long long blocks = in.count(b);
  for (int i = 0; i < 3; ++i) in.number<std::size_t>(b);
  std::vector<long long> nodes;
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = in.whole(b), tag = in.whole(b), type = in.whole(b);
    const auto groups = entities.find({dimension, tag});
    for (long long n = in.count(b); n > 0; --n) {
      const long long number = in.number<std::size_t>(b);
      nodes.resize(GmshFile::node_count(in, type, number, b));
      if (GmshFile::dimension_of(type) != dimension)
        in.fail("a block of an entity of dimension " + std::to_string(dimension) +
                    " has elements of Gmsh type " + std::to_string(type),
                "save the mesh again as MSH 4.1 or 2.2");
      for (long long& k : nodes) k = in.number<std::size_t>(b);
      file.add(in, type, number, nodes, groups == entities.end() ? std::vector<int>{} : groups->second);
    }
  }
}

}  // namespace bulbus::inline mesh
