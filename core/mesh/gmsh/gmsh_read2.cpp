#include "core/mesh/gmsh/gmsh_file.hpp"

namespace bulbus::inline mesh {
namespace {

std::vector<int> physical(std::span<const int> tags) {
  return tags.empty() || tags[0] == 0 ? std::vector<int>{} : std::vector<int>{tags[0]};
}

/// Number, tags and nodes of one element.
void read_element(GmshScanner& in, GmshFile& file, int type, int tag_count, long long number) {
  if (tag_count < 0)
    in.fail("an element has a negative number of tags", "save the mesh again as MSH 4.1 or 2.2");
  std::vector<int> tags;
  for (int i = 0; i < tag_count; ++i) tags.push_back(in.whole(file.binary));
  std::vector<long long> nodes(GmshFile::node_count(in, type, number, file.binary));
  for (long long& k : nodes) k = in.number<int>(file.binary);
  file.add(in, type, number, nodes, physical(tags));
}

}  // namespace

void read_nodes2(GmshScanner& in, GmshFile& file) {
  const long long count = in.count(false);
  if (file.binary) in.skip_line();
  for (long long n = 0; n < count; ++n) {
    const long long tag = in.number<int>(file.binary);
    Point p;
    for (double& x : p) x = in.real(file.binary);
    file.add_node(in, tag, p);
  }
}

void read_elements2(GmshScanner& in, GmshFile& file) {
  const long long count = in.count(false);
  if (file.binary) in.skip_line();
  for (long long n = 0; n < count;) {
    if (!file.binary) {
      const long long number = in.integer();
      const int type = in.whole(false), tags = in.whole(false);
      read_element(in, file, type, tags, number);
      ++n;
      continue;
    }
    const int type = in.bytes<int>(), block = in.bytes<int>(), tags = in.bytes<int>();
    if (block < 1) in.fail("a block of elements is empty", "save the mesh again");
    for (int i = 0; i < block; ++i, ++n) {
      const long long number = in.bytes<int>();
      read_element(in, file, type, tags, number);
    }
  }
}

}  // namespace bulbus::inline mesh
