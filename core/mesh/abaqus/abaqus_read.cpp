#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/mesh/abaqus/abaqus.hpp"
#include "core/mesh/abaqus/abaqus_model.hpp"

namespace bulbus::inline mesh {
namespace {

// Keywords that make, copy or move nodes and elements: a mesh without what they say would be another one.
const std::set<std::string> generators{
    "NGEN",     "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPORT", "SUBSTRUCTURE PATH",
    "PARAMETER"};

const std::string& needed(AbaqusLines& in, const AbaqusKeyword& keyword, const char* key) {
  const std::string* value = keyword.find(key);
  if (!value || value->empty())
    in.fail(keyword.place, fmt::format("*{} has no {}", keyword.name, key),
            fmt::format("write *{}, {}=NAME", keyword.name, key));
  return *value;
}

bool is_hexahedron(const std::string& type) {
  return type.starts_with("C3D8") &&
         std::all_of(type.begin() + 4, type.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

class AbaqusReader {
 public:
  explicit AbaqusReader(const std::string& path) : in_(path) { model_.parts.emplace_back(); }

  AbaqusModel read() {
    if (in_.at_data()) in_.fail("this is no Abaqus input: it begins with data", "give a file of *KEYWORDs");
    while (!in_.at_end()) {
      const AbaqusKeyword keyword = in_.keyword();
      take(keyword);
      while (in_.at_data()) in_.next();  // of a keyword that is skipped
    }
    model_.files = in_.files();
    return std::move(model_);
  }

 private:
  void take(const AbaqusKeyword& keyword) {
    const std::string& name = keyword.name;
    if (generators.contains(name))
      in_.fail(keyword.place, "*" + name + " is not read",
               "write the mesh with all nodes in Cartesian coordinates and all elements");
    static const std::set<std::string> of_parts{"NODE",  "ELEMENT", "NSET",
                                                "ELSET", "SURFACE", "SOLID SECTION"};
    if (in_instance_ && of_parts.contains(name))
      in_.fail(keyword.place, "*" + name + " inside of *INSTANCE is not read", "write it into the *PART");
    if (const std::string* file = keyword.find("INPUT"); file && of_parts.contains(name))
      in_.fail(keyword.place, "*" + name + " with INPUT='" + printable(*file, true) + "' is not read",
               "write the data below the keyword, or *INCLUDE, INPUT=" + printable(*file, true) + " there");
    if (name == "NODE") return nodes(keyword);
    if (name == "ELEMENT") return elements(keyword);
    if (name == "NSET" || name == "ELSET") return read_abaqus_set(in_, keyword, scope(), in_assembly_);
    if (name == "SURFACE") return read_abaqus_surface(in_, keyword, scope(), in_assembly_);
    if (name == "SOLID SECTION") return section(keyword);
    if (name == "PART") return begin_part(keyword);
    if (name == "INSTANCE") return instance(keyword);
    if (name == "ASSEMBLY") in_assembly_ = true;
    if (name == "END ASSEMBLY") in_assembly_ = false;
    if (name == "END PART") part_ = 0;
    if (name == "END INSTANCE") in_instance_ = false;
    static const std::set<std::string> known{"ASSEMBLY",     "END ASSEMBLY", "END PART",
                                             "END INSTANCE", "HEADING",      "PREPRINT"};
    if (!known.contains(name)) ++model_.skipped[printable(name) + (keyword.has("TIED") ? ", TIED" : "")];
  }

  AbaqusPart& part() { return model_.parts[part_]; }
  AbaqusScope& scope() { return in_assembly_ ? model_.assembly : part(); }

  void nodes(const AbaqusKeyword& keyword) {
    if (const std::string* system = keyword.find("SYSTEM"); system && in_capitals(*system) != "R")
      in_.fail(keyword.place, "nodes in the coordinate system '" + printable(*system) + "' are not read",
               "write Cartesian coordinates");
    const std::string* name = keyword.find("NSET");
    AbaqusMembers* set =
        name && !in_assembly_ ? &members_of(part().node_sets, *name, keyword.place) : nullptr;
    for (; in_.at_data(); in_.next()) {
      const auto& words = in_.fields();
      if (words.empty()) in_.fail("a node has no number", "write: number, x, y, z");
      const int label = in_.label(words[0]);
      Point p{};
      for (std::size_t i = 0; i < 3 && i + 1 < words.size(); ++i)
        if (!words[i + 1].empty()) p[i] = in_.real(words[i + 1]);
      if (in_assembly_) continue;  // reference points: no part of the mesh
      part().points.push_back(p);
      part().labels.push_back(label);
      part().places.push_back(in_.place());
      if (set) add_label(*set, label);
    }
  }

  void elements(const AbaqusKeyword& keyword) {
    const std::string type = in_capitals(needed(in_, keyword, "TYPE"));
    if (!is_hexahedron(type)) return other_elements(type, keyword);
    if (in_assembly_)
      in_.fail(keyword.place, "hexahedra of the assembly are not read", "define them in a *PART");
    const std::string* name = keyword.find("ELSET");
    AbaqusMembers* set = name ? &members_of(part().element_sets, *name, keyword.place) : nullptr;
    const int block = name ? block_of(*name) : -1;
    while (in_.at_data()) {
      part().elements.push_back(hexahedron(block));
      if (set) add_label(*set, part().elements.back().label);
    }
  }

  int block_of(const std::string& name) {
    auto& blocks = part().blocks;
    const auto at = std::ranges::find(blocks, in_capitals(name), in_capitals);
    if (at == blocks.end()) blocks.push_back(name);
    return static_cast<int>(std::ranges::find(blocks, in_capitals(name), in_capitals) - blocks.begin());
  }

  // Its number and its eight nodes, on one line or several.
  AbaqusPart::Element hexahedron(int block) {
    AbaqusPart::Element e{0, block, {}, in_.place()};
    int count = 0;
    for (; count < 9 && in_.at_data(); in_.next())
      for (const std::string_view word : in_.fields()) {
        if (count == 9)
          in_.fail(fmt::format("element {} has more than eight nodes", e.label),
                   "give every element lines of its own, and hexahedra of first order");
        (count == 0 ? e.label : e.labels[count - 1]) = in_.label(word);
        ++count;
      }
    if (count < 9)
      in_.fail(e.place, fmt::format("element {} has {} of its eight nodes", e.label, std::max(count - 1, 0)),
               "write: number and eight nodes; the file may have been cut off");
    return e;
  }

  void other_elements(const std::string& type, const AbaqusKeyword& keyword) {
    if (model_.others.empty()) model_.first_other = keyword.place;
    long long& count = model_.others["of type " + printable(type)];
    for (bool continued = false; in_.at_data(); in_.next()) {
      count += !continued;
      continued = in_.continues();
    }
  }

  void section(const AbaqusKeyword& keyword) {
    part().sections.push_back({needed(in_, keyword, "ELSET"), keyword.place});
  }

  void begin_part(const AbaqusKeyword& keyword) {
    const std::string& name = needed(in_, keyword, "NAME");
    for (const AbaqusPart& p : model_.parts)
      if (in_capitals(p.name) == in_capitals(name))
        in_.fail(keyword.place, "two parts are named '" + printable(name, true) + "'",
                 "give each its own name");
    part_ = static_cast<int>(model_.parts.size());
    model_.parts.emplace_back().name = name;
  }

  void instance(const AbaqusKeyword& keyword) {
    AbaqusInstance made;
    made.name = needed(in_, keyword, "NAME");
    made.part = needed(in_, keyword, "PART");
    made.place = keyword.place;
    for (const AbaqusInstance& i : model_.instances)
      if (in_capitals(i.name) == in_capitals(made.name))
        in_.fail(keyword.place, "two instances are named '" + printable(made.name, true) + "'",
                 "give each its own name");
    in_instance_ = true;
    std::vector<double> numbers;  // translation; two points of the axis and the angle
    for (; in_.at_data() && numbers.size() < 10; in_.next())
      for (const std::string_view word : in_.fields()) numbers.push_back(word.empty() ? 0 : in_.real(word));
    if (!numbers.empty() && numbers.size() != 3 && numbers.size() != 10)
      in_.fail(keyword.place,
               fmt::format("instance '{}' has {} numbers", printable(made.name, true), numbers.size()),
               "give three of a translation, or these and seven of a rotation (two points, an angle)");
    numbers.resize(10);
    std::copy_n(numbers.begin(), 3, made.shift.begin());
    std::copy_n(numbers.begin() + 3, 3, made.a.begin());
    std::copy_n(numbers.begin() + 6, 3, made.b.begin());
    made.angle = numbers[9];
    if (made.angle != 0 && made.a == made.b)
      in_.fail(keyword.place, "the axis of a rotation has no direction", "give two points that differ");
    model_.instances.push_back(made);
  }

  AbaqusLines in_;
  AbaqusModel model_;
  int part_ = 0;
  bool in_assembly_ = false, in_instance_ = false;
};

}  // namespace

void AbaqusModel::fail(const AbaqusPlace& at, const std::string& what, const std::string& remedy) const {
  throw input_error(files[at.file], at.line, what, remedy);
}

AbaqusModel read_abaqus_model(const std::string& path) { return AbaqusReader(path).read(); }

ReadMesh read_abaqus(const std::string& path) { return mesh_of(read_abaqus_model(path)); }

}  // namespace bulbus::inline mesh
