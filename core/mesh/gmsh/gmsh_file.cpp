#include "core/mesh/gmsh/gmsh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace bulbus::inline mesh {
namespace {

const char* const use_hexahedra =
    "mesh volumes with 8-node hexahedra and surfaces with quads: transfinite with Recombine, Recombine 3D, "
    "or Mesh.SubdivisionAlgorithm = 2 in Gmsh";

// Cells of first order that are counted before they are refused.
struct OtherType {
  const char *one, *many;
  int nodes;
};
const std::map<int, OtherType> other_types{{2, {"a triangle", "triangles", 3}},
                                           {4, {"a tetrahedron", "tetrahedra", 4}},
                                           {6, {"a prism", "prisms", 6}},
                                           {7, {"a pyramid", "pyramids", 5}}};

std::string name_of(long long number) { return "element " + std::to_string(number); }

}  // namespace

int GmshFile::dimension_of(int type) {
  if (other_types.contains(type)) return type == 2 ? 2 : 3;
  return type == 5 ? 3 : type == 3 ? 2 : type == 1 ? 1 : 0;
}

int GmshFile::node_count(const GmshScanner& at, int type, long long number, bool binary) {
  switch (type) {
    case 1:
      return 2;
    case 3:
      return 4;
    case 5:
      return 8;
    case 15:
      return 1;
  }
  if (const auto other = other_types.find(type); other != other_types.end()) return other->second.nodes;
  throw input_error(at.path(), binary ? 0 : at.line(),
                    fmt::format("{} is of Gmsh type {}, of higher order", name_of(number), type),
                    "save a mesh of first order (Mesh.ElementOrder = 1)");
}

void GmshFile::add_node(const GmshScanner& at, long long tag, const Point& p) {
  if (!index.try_emplace(tag, static_cast<int>(points.size())).second)
    throw input_error(path, binary ? 0 : at.line(), "node " + std::to_string(tag) + " appears twice",
                      "give every node a number of its own");
  for (double x : p)
    if (!std::isfinite(x))
      throw input_error(path, binary ? 0 : at.line(), fmt::format("node {} has the coordinate {}", tag, x),
                        "give the node a finite position, or mesh the model again");
  points.push_back(p);
}

void GmshFile::add(const GmshScanner& at, int type, long long number, std::span<const long long> nodes,
                   std::span<const int> groups) {
  Element e{dimension_of(type), 0, binary ? 0 : at.line(), number, {}};
  if (const auto other = other_types.find(type); other != other_types.end()) {
    if (others.empty()) first_other = e, first_other.group = type;
    ++others[other->second.many];
    return;
  }
  if (e.dimension == 3 && groups.empty())
    refuse(e, "is a hexahedron in no physical group",
           "add its volume to a Physical Volume: it names the region");
  if (e.dimension == 3 && groups.size() > 1)
    refuse(e, "is in several physical volumes", "let every volume belong to one Physical Volume");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto found = index.find(nodes[i]);
    if (found == index.end())
      refuse(e, "has node " + std::to_string(nodes[i]) + ", which the file lacks",
             "save all nodes of the mesh");
    e.nodes[i] = found->second;
  }
  for (int g : groups) {
    e.group = g < 0 ? -g : g;  // negative: a reversed entity
    elements.push_back(e);
  }
}

std::string GmshFile::group_name(int dimension, int tag) const {
  const auto at = names.find({dimension, tag});
  if (at != names.end()) return at->second;
  static const char* const kinds[] = {"points", "bars", "surface", "region"};
  return std::string(kinds[dimension]) + "_" + std::to_string(tag);
}

void GmshFile::refuse(const Element& e, const std::string& what, const std::string& remedy) const {
  throw input_error(path, e.line, name_of(e.number) + " " + what, remedy);
}

void GmshFile::refuse_others() const {
  if (others.empty()) return;
  const auto hexahedra = std::ranges::count(elements, 3, &Element::dimension);
  refuse(first_other,
         fmt::format("is {}: {}", other_types.at(first_other.group).one, other_cells_text(others, hexahedra)),
         use_hexahedra);
}

}  // namespace bulbus::inline mesh
