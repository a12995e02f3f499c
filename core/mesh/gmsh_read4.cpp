#include "core/mesh/gmsh_file.hpp"

namespace bulbus {

GmshEntities read_entities4(GmshScanner& in, const GmshFile& file) {
  const bool b = file.binary;
  GmshEntities entities;
  long long counts[4];
  for (long long& c : counts) c = in.number<std::size_t>(b);
  for (int dimension = 0; dimension < 4; ++dimension)
    for (long long n = 0; n < counts[dimension]; ++n) {
      const int tag = static_cast<int>(in.number<int>(b));
      for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) in.real(b);  // place, or bounding box
      std::vector<int>& groups = entities[{dimension, tag}];
      for (long long g = in.number<std::size_t>(b); g > 0; --g)
        groups.push_back(static_cast<int>(in.number<int>(b)));
      if (dimension == 0) continue;
      for (long long g = in.number<std::size_t>(b); g > 0; --g) in.number<int>(b);  // bounding entities
    }
  return entities;
}

void read_nodes4(GmshScanner& in, GmshFile& file) {
  const bool b = file.binary;
  const long long blocks = in.number<std::size_t>(b);
  for (int i = 0; i < 3; ++i) in.number<std::size_t>(b);  // number of nodes, least and greatest tag
  std::vector<long long> tags;
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = static_cast<int>(in.number<int>(b));
    in.number<int>(b);
    const bool parametric = in.number<int>(b) != 0;
    tags.clear();
    for (long long n = in.number<std::size_t>(b); n > 0; --n) tags.push_back(in.number<std::size_t>(b));
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
  const long long blocks = in.number<std::size_t>(b);
  for (int i = 0; i < 3; ++i) in.number<std::size_t>(b);
  std::vector<long long> nodes;
  for (long long block = 0; block < blocks; ++block) {
    const int dimension = static_cast<int>(in.number<int>(b)), tag = static_cast<int>(in.number<int>(b));
    const int type = static_cast<int>(in.number<int>(b));
    const auto groups = entities.find({dimension, tag});
    for (long long n = in.number<std::size_t>(b); n > 0; --n) {
      const long long number = in.number<std::size_t>(b);
      nodes.resize(GmshFile::node_count(in, type, number, b));
      for (long long& k : nodes) k = in.number<std::size_t>(b);
      file.add(in, type, number, nodes, groups == entities.end() ? std::vector<int>{} : groups->second);
    }
  }
}

}  // namespace bulbus
