#include "app/scene/key_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <span>

#include "app/scene/schema_tree.hpp"
#include "app/scene/text_format.hpp"
#include "app/study/study.hpp"

namespace bulbus::inline app {
namespace {

using Kind = SchemaNode::Kind;

std::string plain_type(const SchemaNode& t) {
  switch (t.kind) {
    case Kind::truth:
      return "true or false";
    case Kind::integer:
      return "whole number";
    case Kind::number:
      return "number";
    case Kind::point:
      return "[x, y, z]";
    case Kind::group:
      return "map";
    case Kind::list:
      return "list of " + plain_type(t.parts[0]);
    case Kind::map:
      return "NAME: " + plain_type(t.parts[0]);
    case Kind::any:
      return "any value";
    default:
      return t.about.formula ? "number or formula" : t.about.choices.empty() ? "text" : "word";
  }
}

std::string default_text(const SchemaNode& t) {
  if (t.about.required) return ", needed";
  if (t.optional) return ", optional";
  if (t.kind == Kind::group) return "";
  std::string value = to_yaml(t.fallback);
  value.pop_back();  // the line's end
  return value == "\"\"" || value == "[]" || value == "{}" ? "" : ", default " + value;
}

std::string facts(const SchemaNode& t) {
  const std::string unit = unit_of(t.about.quantity), bounds = bounds_text(t.about);
  return plain_type(t) + (unit.empty() ? "" : " in " + unit) + default_text(t) +
         (bounds.empty() ? "" : ", " + bounds);
}

const SchemaNode& innermost(const SchemaNode& t) {
  return t.kind == Kind::list || t.kind == Kind::map ? innermost(t.parts[0]) : t;
}

// What stands in a path for the entries of lists and maps.
std::string entries_of(const SchemaNode& t) {
  if (t.kind == Kind::list) return "0." + entries_of(t.parts[0]);
  return t.kind == Kind::map ? "NAME." + entries_of(t.parts[0]) : "";
}

// The conditions that what is around does not have.
std::string own_conditions(const SchemaNode& t, const SchemaNode& around) {
  return conditions_text(std::span(t.about.conditions).subspan(innermost(around).about.conditions.size()));
}

void add_keys(const SchemaNode& t, const SchemaNode& around, const std::string& before, int depth,
              std::vector<KeyLine>& lines) {
  const SchemaNode& inner = innermost(t);
  const std::string words = t.about.choices.empty() ? "" : " (" + alternatives(t.about.choices) + ")";
  const bool truth = t.kind == Kind::truth;
  lines.push_back({.key = t.key,
                   .path = before + t.key,
                   .depth = depth,
                   .facts = facts(t),
                   .about = t.about.help,
                   .help = t.about.help + words + own_conditions(t, around),
                   .words = truth ? std::vector<std::string>{"true", "false"} : t.about.choices,
                   .level = t.about.level,
                   .group = t.kind == Kind::group,
                   .has_keys = !inner.parts.empty()});
  for (const SchemaNode& part : inner.parts)
    add_keys(part, t, before + t.key + "." + entries_of(t), depth + 1, lines);
}

template <class T>
std::vector<KeyLine> keys_of() {
  T defaults;
  const SchemaNode root = schema_tree_of("", About{""}, parameters_of(defaults));
  std::vector<KeyLine> lines;
  for (const SchemaNode& part : root.parts) add_keys(part, root, "", 0, lines);
  return lines;
}

}  // namespace

std::vector<KeyLine> scene_keys() { return keys_of<Scene>(); }

std::vector<KeyLine> study_keys() { return keys_of<Study>(); }

std::string plain_path(const std::string& path) {
  std::string plain;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('.', at), path.size());
    const std::string part = path.substr(at, end - at);
    const bool place =
        !part.empty() && std::ranges::all_of(part, [](unsigned char c) { return std::isdigit(c); });
    if (!place && part != "NAME") plain += (plain.empty() ? "" : ".") + part;
    at = end + 1;
  }
  return plain;
}

}  // namespace bulbus::inline app
