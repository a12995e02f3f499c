#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/mesh/abaqus/abaqus_resolve.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/repeated.hpp"

namespace bulbus::inline mesh {
namespace {

using Kind = AbaqusResolver::Kind;

// Keywords that join nodes which have no element in common, or keep their distances: what is read without
// them is another body.
const std::set<std::string> constraints{"TIE",
                                        "EQUATION",
                                        "MPC",
                                        "NETWORK MPC",
                                        "COUPLING",
                                        "KINEMATIC COUPLING",
                                        "DISTRIBUTING COUPLING",
                                        "SHELL TO SOLID COUPLING",
                                        "RIGID BODY",
                                        "EMBEDDED ELEMENT",
                                        "CYCLIC SYMMETRY MODEL",
                                        "FASTENER",
                                        "CONTACT PAIR, TIED"};

// "*A, *B (2 times)": at most 20 keywords.
std::string listed(const std::map<std::string, int>& keywords) {
  std::string names;
  int shown = 0;
  for (const auto& [name, count] : keywords)
    if (++shown <= 20)
      names += fmt::format("{}*{}{}", shown > 1 ? ", " : "", name,
                           count > 1 ? fmt::format(" ({} times)", count) : "");
  return shown > 20 ? names + fmt::format(" and {} others", shown - 20) : names;
}

// Rodrigues: x turns by the angle about the axis through a.
Point placed(const AbaqusInstance& instance, Point x) {
  x = x + instance.shift;
  if (instance.angle == 0) return x;
  const Point axis = instance.b - instance.a, k = (1 / norm(axis)) * axis, r = x - instance.a;
  const double angle = instance.angle * std::numbers::pi / 180;
  return instance.a + std::cos(angle) * r + std::sin(angle) * cross(k, r) +
         ((1 - std::cos(angle)) * dot(k, r)) * k;
}

class Assembler {
 public:
  explicit Assembler(const AbaqusModel& model) : model_(model), resolver_(model) {}

  ReadMesh mesh() {
    for (int i = 0; i < resolver_.instances(); ++i) add_instance(i);
    if (mesh_.hexes.empty())
      throw input_error(model_.files[0], 0, "the mesh has no hexahedra",
                        "give *ELEMENT of type C3D8, and an *INSTANCE of every *PART that is meant");
    const bool with_sections =
        std::ranges::any_of(model_.parts, [](const AbaqusPart& p) { return !p.sections.empty(); });
    mesh_.region.assign(mesh_.hexes.size(), -1);
    for (int i = 0; i < resolver_.instances(); ++i) with_sections ? take_sections(i) : take_blocks(i);
    refuse_without_region(with_sections);
    refuse_repeated();
    number_ = drop_unused_points(mesh_);
    turned_ = turn_inverted(mesh_);
    for (int i = AbaqusResolver::assembly; i < resolver_.instances(); ++i) {
      add_node_sets(i);
      add_surfaces(i);
    }
    note_sets_of_no_instance();
    note_skipped();
    return {std::move(mesh_), std::move(notes_), std::move(warnings_)};
  }

 private:
  void add_instance(int i) {
    const AbaqusPart& part = resolver_.part(i);
    for (const Point& p : part.points) {
      const Point& x = mesh_.points.emplace_back(placed(model_.instances[i], p));
      if (!std::ranges::all_of(x, [](double c) { return std::isfinite(c); }))
        model_.fail(model_.instances[i].place, "the instance moves nodes to no finite position",
                    "give a translation and an axis of a size like that of the mesh");
    }
    for (const auto& e : part.elements) {
      Hex& h = mesh_.hexes.emplace_back();
      for (int c = 0; c < 8; ++c) {
        const int node = resolver_.nodes(i).find(e.labels[c]);
        if (node < 0)
          model_.fail(e.place,
                      fmt::format("element {} has node {}, which the file lacks", e.label, e.labels[c]),
                      "write all nodes of the mesh");
        h[c] = resolver_.first_node(i) + node;
      }
    }
  }

  // Of a part: behind its instance's name where that is needed to tell it from others.
  std::string display(int instance, const std::string& name, bool in_assembly) const {
    if (instance == AbaqusResolver::assembly) return name;
    const std::string& of = model_.instances[instance].name;
    return !of.empty() && (in_assembly || resolver_.instances() > 1) ? of + "." + name : name;
  }

  int region_named(const std::string& name) {
    if (const int r = region_index(mesh_, name); r >= 0) return r;
    mesh_.region_names.push_back(name);
    return static_cast<int>(mesh_.region_names.size()) - 1;
  }

  void take_sections(int i) {
    for (const AbaqusPart::Section& section : resolver_.part(i).sections) {
      const auto& elements = resolver_.set(Kind::elements, i, section.elements, section.place);
      if (elements.empty()) continue;
      const AbaqusSet& set = resolver_.part(i).element_sets.at(in_capitals(section.elements));
      const int region = region_named(display(i, set.name, false));
      const auto taken = [&](int e) { return mesh_.region[e] >= 0 && mesh_.region[e] != region; };
      if (const auto twice = std::ranges::find_if(elements, taken); twice != elements.end())
        model_.fail(
            section.place,
            fmt::format("{} of {} elements of '{}' are in another *SOLID SECTION: element {} is in '{}'",
                        std::ranges::count_if(elements, taken), elements.size(),
                        printable(mesh_.region_names[region], true), resolver_.element(*twice).label,
                        printable(mesh_.region_names[mesh_.region[*twice]], true)),
            "let every element belong to one section");
      for (int e : elements) mesh_.region[e] = region;
    }
  }

  void take_blocks(int i) {
    const AbaqusPart& part = resolver_.part(i);
    std::vector<int> regions;
    for (const std::string& name : part.blocks) regions.push_back(region_named(display(i, name, false)));
    for (std::size_t e = 0; e < part.elements.size(); ++e)
      if (const int block = part.elements[e].block; block >= 0)
        mesh_.region[resolver_.first_hex(i) + e] = regions[block];
  }

  void refuse_without_region(bool with_sections) const {
    const auto first = std::ranges::find(mesh_.region, -1);
    if (first == mesh_.region.end()) return;
    const auto& e = resolver_.element(static_cast<int>(first - mesh_.region.begin()));
    model_.fail(
        e.place,
        fmt::format("{} of {} elements are in no {}: element {} is the first",
                    std::ranges::count(mesh_.region, -1), mesh_.region.size(),
                    with_sections ? "*SOLID SECTION" : "region", e.label),
        "give every element a *SOLID SECTION, or the ELSET of its *ELEMENT line: it names the region");
  }

  void refuse_repeated() const {
    const auto pairs = repeated(mesh_.hexes);
    if (pairs.empty()) return;
    const auto &first = resolver_.element(pairs[0].first), &again = resolver_.element(pairs[0].second);
    model_.fail(
        again.place,
        fmt::format("element {} has the same eight nodes as element {}: {} of {} hexahedra stand twice",
                    again.label, first.label, pairs.size(), mesh_.hexes.size()),
        "write every element once");
  }

  void add_node_set(const std::string& name, const std::vector<int>& nodes) {
    std::vector<int> kept;
    for (int n : nodes)
      if (number_[n] >= 0) kept.push_back(number_[n]);
    if (kept.empty())
      notes_.push_back("node set '" + printable(name, true) +
                       "' is left out: it has no node of a hexahedron");
    else
      mesh_.node_sets[name] = std::move(kept);
  }

  const AbaqusScope& scope(int i) const {
    return i == AbaqusResolver::assembly ? model_.assembly : resolver_.part(i);
  }

  bool in_assembly(const std::string& key) const {
    return model_.assembly.node_sets.contains(key) || model_.assembly.surfaces.contains(key);
  }

  void add_node_sets(int i) {
    for (const auto& [key, set] : scope(i).node_sets)
      if (!set.internal)
        add_node_set(display(i, set.name, in_assembly(key)), resolver_.set(Kind::nodes, i, set.name, {}));
  }

  void add_surfaces(int i) {
    for (const auto& [key, surface] : scope(i).surfaces) {
      const std::string name = display(i, surface.name, in_assembly(key));
      if (surface.of_nodes)
        add_node_set(name, nodes_of(i, surface, name));
      else
        mesh_.surfaces[name] = faces_of(i, surface);
    }
  }

  std::vector<int> nodes_of(int i, const AbaqusSurface& surface, const std::string& name) {
    if (mesh_.node_sets.contains(name))
      model_.fail(surface.place,
                  "a node set and a surface of nodes are both named '" + printable(name, true) + "'",
                  "give them two names");
    std::vector<int> nodes;
    for (const auto& row : surface.rows)
      for (int n : resolver_.of(Kind::nodes, i, row.members)) nodes.push_back(n);
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  // S1 to S6 are the local faces 0 to 5, unless the cell was turned.
  int face(int hex, int local) const { return 6 * hex + (turned_[hex] && local < 2 ? 1 - local : local); }

  std::vector<Quad> faces_of(int i, const AbaqusSurface& surface) {
    std::vector<bool> seen(6 * mesh_.hexes.size());
    std::vector<Quad> quads;
    const auto add = [&](int f) {
      if (!seen[f]) quads.push_back(face_nodes(mesh_.hexes, f));
      seen[f] = true;
    };
    for (const auto& row : surface.rows)
      for (int hex : resolver_.of(Kind::elements, i, row.members)) {
        if (row.face >= 0) add(face(hex, row.face));
        for (int f = 6 * hex; row.face < 0 && f < 6 * hex + 6; ++f)
          if (faces().count(face_nodes(mesh_.hexes, f)) == 1) add(f);
      }
    if (quads.empty())
      model_.fail(surface.place, "the surface '" + printable(surface.name, true) + "' has no faces",
                  "name elements and faces (S1 to S6)");
    return quads;
  }

  const FaceTable& faces() {
    if (!faces_) faces_.emplace(mesh_.hexes);
    return *faces_;
  }

  // Of parts without an instance, and of what stands outside of parts and assembly where no element does.
  void note_sets_of_no_instance() {
    std::string names;
    for (std::size_t p = 0; p < model_.parts.size(); ++p) {
      const AbaqusPart& part = model_.parts[p];
      if (std::ranges::any_of(model_.instances, [&](const AbaqusInstance& i) {
            return in_capitals(i.part) == in_capitals(part.name);
          }))
        continue;
      for (const auto& [key, set] : part.node_sets)
        if (!set.internal) names += (names.empty() ? "'" : ", '") + printable(set.name, true) + "'";
      for (const auto& [key, surface] : part.surfaces)
        names += (names.empty() ? "'" : ", '") + printable(surface.name, true) + "'";
    }
    if (!names.empty())
      notes_.push_back(
          "sets and surfaces are left out that belong to no instance of a part, nor to the "
          "assembly: " +
          names);
  }

  void note_skipped() {
    std::map<std::string, int> joining, others;
    for (const auto& [name, count] : model_.skipped)
      (constraints.contains(name) ? joining : others)[name] = count;
    if (!others.empty()) notes_.push_back("skipped in the mesh file: " + listed(others));
    if (!joining.empty())
      warnings_.push_back("the mesh file has " + listed(joining) +
                          ": constraints are not read, and what they join is not joined here. Give the parts "
                          "common nodes, a rigid part `rigid: true`, or sides that touch a contact");
  }

  const AbaqusModel& model_;
  AbaqusResolver resolver_;
  Mesh mesh_;
  std::vector<std::string> notes_, warnings_;
  std::vector<int> number_;   ///< in the mesh, of the points of all instances
  std::vector<bool> turned_;  ///< per hexahedron
  std::optional<FaceTable> faces_;
};

}  // namespace

ReadMesh mesh_of(AbaqusModel model) {
  if (!model.others.empty()) {
    long long hexes = 0;
    for (const AbaqusPart& part : model.parts) hexes += static_cast<long long>(part.elements.size());
    refuse_other_cells(
        model.files[model.first_other.file], model.first_other.line, model.others, hexes,
        "keep only elements of type C3D8 (or C3D8R, C3D8H, ...) in the mesh file; bars are read "
        "from Gmsh files, rigid bodies are a scene's own");
  }
  if (!model.parts[0].elements.empty())  // what stands outside of parts is an instance of itself
    model.instances.insert(model.instances.begin(), AbaqusInstance{});
  return Assembler(model).mesh();
}

}  // namespace bulbus::inline mesh
