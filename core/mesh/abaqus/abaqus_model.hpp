#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/mesh/abaqus/abaqus_lines.hpp"
#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

/// first, first + step, ... up to last.
struct AbaqusRange {
  int first, last, step = 1;
};

/// What one keyword adds to a set.
struct AbaqusMembers {
  AbaqusPlace place;
  std::string instance;  ///< that the labels and names are of; empty: of the set's own scope
  std::vector<AbaqusRange> ranges;
  bool generated = false;          ///< by GENERATE: labels that do not exist are passed over
  std::vector<std::string> names;  ///< of other sets
  std::string elements;            ///< of a node set: the element set whose nodes it has
};

struct AbaqusSet {
  std::string name;  ///< as it is first spelt
  bool internal = false;
  std::vector<AbaqusMembers> members;
};

struct AbaqusSurface {
  struct Row {
    AbaqusMembers members;
    int face;  ///< 0 to 5; −1: outer faces
  };
  std::string name;
  AbaqusPlace place;
  bool of_nodes = false;
  std::vector<Row> rows;
};

/// Names of a part or of the assembly, by their capitals.
struct AbaqusScope {
  std::map<std::string, AbaqusSet> node_sets, element_sets;
  std::map<std::string, AbaqusSurface> surfaces;
};

struct AbaqusPart : AbaqusScope {
  struct Element {
    int label;
    int block;   ///< index of `blocks`: the ELSET of its *ELEMENT line; −1: none
    Hex labels;  ///< of its nodes
    AbaqusPlace place;
  };
  struct Section {
    std::string elements;
    AbaqusPlace place;
  };
  std::string name;
  std::vector<Point> points;
  std::vector<int> labels;  ///< of the points
  std::vector<AbaqusPlace> places;
  std::vector<Element> elements;
  std::vector<std::string> blocks;
  std::vector<Section> sections;
};

/// A copy of a part, moved by `shift`, then turned by `angle` (degrees) about the line from a to b.
struct AbaqusInstance {
  std::string name, part;
  AbaqusPlace place;
  Point shift{}, a{}, b{};
  double angle = 0;
};

/// What the input file says of its mesh, before it becomes a Mesh.
struct AbaqusModel {
  std::vector<std::string> files;
  std::vector<AbaqusPart> parts;  ///< the first is what stands outside of *PART
  AbaqusScope assembly;
  std::vector<AbaqusInstance> instances;
  OtherCells others;
  AbaqusPlace first_other;
  std::map<std::string, int> skipped;  ///< keywords, how often

  [[noreturn]] void fail(const AbaqusPlace& at, const std::string& what, const std::string& remedy) const;
};

/// Throws InputError with file and line.
AbaqusModel read_abaqus_model(const std::string& path);

/// Bodies of *NSET, *ELSET and *SURFACE.
void read_abaqus_set(AbaqusLines& in, const AbaqusKeyword& keyword, AbaqusScope& scope, bool assembly);
void read_abaqus_surface(AbaqusLines& in, const AbaqusKeyword& keyword, AbaqusScope& scope, bool assembly);

/// Adds a label to a set, which is made if it is new.
AbaqusMembers& members_of(std::map<std::string, AbaqusSet>& sets, const std::string& name,
                          const AbaqusPlace& place);
void add_label(AbaqusMembers& members, int label);

/// The mesh that instances, sections and sets describe.
ReadMesh mesh_of(AbaqusModel model);

}  // namespace bulbus::inline mesh
