// *NSET, *ELSET and *SURFACE: labels and names, as they stand.
#include <fmt/format.h>

#include "core/base/printable.hpp"
#include "core/mesh/abaqus/abaqus_model.hpp"

namespace bulbus::inline mesh {
namespace {

bool is_label(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

// In the assembly, `INSTANCE.5` and `INSTANCE.NAME` are of an instance.
struct Word {
  std::string instance;
  std::string_view rest;
};

Word parted(std::string_view word, const std::string& instance, bool assembly) {
  const std::size_t dot = word.find('.');
  if (!assembly || dot == std::string_view::npos || word.starts_with('"')) return {instance, word};
  return {std::string(word.substr(0, dot)), word.substr(dot + 1)};
}

void add_word(const AbaqusLines& in, AbaqusMembers& members, std::string_view word) {
  if (is_label(word))
    add_label(members, in.label(word));
  else if (!word.empty())
    members.names.push_back(AbaqusLines::name(word));
}

void add_generated(AbaqusLines& in, AbaqusMembers& members) {
  const auto& words = in.fields();
  if (words.size() < 2 || words.size() > 3)
    in.fail("GENERATE needs a first and a last number, and may have a step", "write: first, last, step");
  const AbaqusRange range{in.label(words[0]), in.label(words[1]), words.size() > 2 ? in.label(words[2]) : 1};
  if (range.last < range.first)
    in.fail(fmt::format("the last number {} is less than the first {}", range.last, range.first),
            "write: first, last, step");
  members.ranges.push_back(range);
}

// Of that instance, the one before if it is.
AbaqusMembers& of_instance(AbaqusSet& set, const std::string& instance, const AbaqusPlace& place) {
  if (set.members.empty() || set.members.back().generated || set.members.back().instance != instance ||
      !set.members.back().elements.empty())
    set.members.push_back({place, instance});
  return set.members.back();
}

AbaqusSet& named(std::map<std::string, AbaqusSet>& sets, const std::string& name) {
  AbaqusSet& set = sets[in_capitals(name)];
  if (set.name.empty()) set.name = name;
  return set;
}

}  // namespace

void add_label(AbaqusMembers& members, int label) {
  auto& ranges = members.ranges;
  if (!ranges.empty() && ranges.back().step == 1 && ranges.back().last + 1LL == label)
    ranges.back().last = label;
  else
    ranges.push_back({label, label});
}

AbaqusMembers& members_of(std::map<std::string, AbaqusSet>& sets, const std::string& name,
                          const AbaqusPlace& place) {
  return named(sets, name).members.emplace_back(AbaqusMembers{place});
}

void read_abaqus_set(AbaqusLines& in, const AbaqusKeyword& keyword, AbaqusScope& scope, bool assembly) {
  const bool of_nodes = keyword.name == "NSET";
  const std::string* name = keyword.find(keyword.name);
  if (!name || name->empty())
    in.fail(keyword.place, "*" + keyword.name + " has no name",
            "write *" + keyword.name + ", " + keyword.name + "=NAME");
  AbaqusSet& set = named(of_nodes ? scope.node_sets : scope.element_sets, *name);
  set.internal = keyword.has("INTERNAL");
  const std::string instance = keyword.has("INSTANCE") ? *keyword.find("INSTANCE") : "";
  if (const std::string* elements = keyword.find("ELSET"); of_nodes && elements)
    set.members.push_back({.place = keyword.place, .instance = instance, .elements = *elements});
  if (keyword.has("GENERATE")) {
    AbaqusMembers& members = set.members.emplace_back(AbaqusMembers{keyword.place, instance});
    members.generated = true;
    for (; in.at_data(); in.next()) add_generated(in, members);
    return;
  }
  for (; in.at_data(); in.next())
    for (const std::string_view word : in.fields()) {
      const Word w = parted(word, instance, assembly);
      add_word(in, of_instance(set, w.instance, in.place()), w.rest);
    }
}

void read_abaqus_surface(AbaqusLines& in, const AbaqusKeyword& keyword, AbaqusScope& scope, bool assembly) {
  const std::string* name = keyword.find("NAME");
  if (!name || name->empty()) in.fail(keyword.place, "*SURFACE has no name", "write *SURFACE, NAME=NAME");
  const std::string type = keyword.has("TYPE") ? in_capitals(*keyword.find("TYPE")) : "ELEMENT";
  if (type != "ELEMENT" && type != "NODE")
    in.fail(keyword.place, fmt::format("surfaces of type {} are not read", printable(type)),
            "name faces of elements (TYPE=ELEMENT) or nodes (TYPE=NODE)");
  if (keyword.has("COMBINE") || keyword.has("CROP"))
    in.fail(keyword.place, "surfaces that are made of other surfaces are not read", "list their faces");
  AbaqusSurface& surface = scope.surfaces[in_capitals(*name)];
  if (surface.name.empty()) surface = {*name, keyword.place, type == "NODE"};
  if (surface.of_nodes != (type == "NODE"))
    in.fail(keyword.place, "the surface '" + printable(*name, true) + "' is of two types",
            "give it two names");
  for (; in.at_data(); in.next()) {
    const auto& words = in.fields();
    if (words.empty()) in.fail("a surface names no elements", "write: element or set, face");
    const Word w = parted(words[0], "", assembly);
    AbaqusSurface::Row row{{.place = in.place(), .instance = w.instance}, -1};
    add_word(in, row.members, w.rest);
    const std::string face = in_capitals(words.size() > 1 ? words[1] : "");
    if (!surface.of_nodes && !face.empty()) {
      if (face.size() != 2 || face[0] != 'S' || face[1] < '1' || face[1] > '6')
        in.fail(fmt::format("'{}' is no face of a hexahedron", printable(face)), "they are S1 to S6");
      row.face = face[1] - '1';
    }
    surface.rows.push_back(std::move(row));
  }
}

}  // namespace bulbus::inline mesh
