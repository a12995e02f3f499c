#pragma once
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/mesh/gmsh/gmsh_scanner.hpp"
#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

/// What a Gmsh file says, before it becomes a Mesh.
struct GmshFile {
  struct Element {
    int dimension;
    int group;  ///< physical tag
    int line;   ///< 0 in a binary file
    long long number;
    std::array<int, 8> nodes;  ///< indices of points
  };
  std::string path;
  bool binary = false;
  std::map<std::pair<int, int>, std::string> names;  ///< (dimension, physical tag)
  std::vector<Point> points;
  std::unordered_map<long long, int> index;  ///< of a node's tag
  std::vector<Element> elements;
  OtherCells others;      ///< triangles, tetrahedra, prisms and pyramids
  Element first_other{};  ///< its group is its type

  /// Counts triangles, tetrahedra, prisms and pyramids; refuses unknown nodes and hexahedra not in just one
  /// physical group; ignores other elements without a group.
  void add(const GmshScanner& at, int type, long long number, std::span<const long long> nodes,
           std::span<const int> groups);
  void add_node(const GmshScanner& at, long long tag, const Point& p);

  /// Nodes of an element type; refuses types that are not supported.
  static int node_count(const GmshScanner& at, int type, long long number, bool binary);
  /// Of a supported type.
  static int dimension_of(int type);
  /// Name of a physical group, made up from its tag if it has none.
  std::string group_name(int dimension, int tag) const;
  /// `file:line: element NUMBER what`.
  [[noreturn]] void refuse(const Element& e, const std::string& what, const std::string& remedy) const;
  /// With how many there are of which kind, where there are any.
  void refuse_others() const;
};

/// Bodies of the sections, up to their $End.
void read_nodes2(GmshScanner& in, GmshFile& file);
void read_elements2(GmshScanner& in, GmshFile& file);

/// Physical tags per entity (dimension, tag).
using GmshEntities = std::map<std::pair<int, int>, std::vector<int>>;
GmshEntities read_entities4(GmshScanner& in, const GmshFile& file);
/// Physical tags of one entity, behind its own tag (and parent).
std::vector<int> read_entity4(GmshScanner& in, bool binary, int dimension);
/// Adds the parts of a partitioned mesh's entities, with the physical tags of their parents where they have
/// none.
void read_partitioned4(GmshScanner& in, const GmshFile& file, GmshEntities& entities);
void read_nodes4(GmshScanner& in, GmshFile& file);
void read_elements4(GmshScanner& in, GmshFile& file, const GmshEntities& entities);

/// The mesh that the elements and groups describe.
Mesh mesh_of(const GmshFile& file);

}  // namespace bulbus::inline mesh
