#include "app/scene/help.hpp"

#include <fmt/format.h>

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

// The conditions that what is around does not have.
std::string own_conditions(const SchemaNode& t, const SchemaNode& around) {
  return conditions_text(std::span(t.about.conditions).subspan(innermost(around).about.conditions.size()));
}

void write(const SchemaNode& t, const SchemaNode& around, Level most, int indent, std::string& out) {
  if (t.about.level > most) return;
  const std::string words = t.about.choices.empty() ? "" : " (" + alternatives(t.about.choices) + ")";
  out += fmt::format("{:<22}  {:<40}  {}{}{}\n", std::string(indent, ' ') + t.key, facts(t), t.about.help,
                     words, own_conditions(t, around));
  for (const SchemaNode& part : innermost(t).parts) write(part, t, most, indent + 2, out);
}

template <class T>
SchemaNode schema_tree_of() {
  T defaults;
  return schema_tree_of("", About{""}, parameters_of(defaults));
}

std::string help_of(const SchemaNode& root, std::string introduction, Level most) {
  for (const SchemaNode& part : root.parts) write(part, root, most, 0, introduction);
  return introduction;
}

// Keys of a level that hold a value.
int count(const SchemaNode& t, Level level) {
  int sum = t.kind != Kind::group && t.about.level == level;
  for (const SchemaNode& part : innermost(t).parts) sum += count(part, level);
  return sum;
}

std::string what_is_left_out(Level most) {
  const SchemaNode root = schema_tree_of<Scene>();
  const int expert = most < Level::expert ? count(root, Level::expert) : 0,
            debug = most < Level::debug ? count(root, Level::debug) : 0;
  if (debug == 0) return "";
  return expert > 0 ? fmt::format(
                          "\n{} settings for experts and {} for debugging are not shown: 'bulbus help "
                          "scene --expert' adds the\nformer, '--all' both.\n",
                          expert, debug)
                    : fmt::format(
                          "\n{} settings for debugging are not shown: 'bulbus help scene --all' adds them.\n",
                          debug);
}

}  // namespace

std::string scene_help(Level most) {
  return help_of(
             schema_tree_of<Scene>(),
             "A scene is a YAML file. Lengths in mm, forces in N, stresses in MPa, angles in rad; a value "
             "may carry its own\n"
             "unit (15 mmHg). A formula may use X, Y, Z (mm), s (0 to 1 over the step) and t (steps done + "
             "s).\n\n",
             most) +
         what_is_left_out(most);
}

std::string study_help() {
  return help_of(
      schema_tree_of<Study>(),
      "A study is a YAML file: a scene, and what to vary in it. Keys of the scene are paths such as\n"
      "steps.1.increments; entries of lists count from 0, or go by their name. Runs save no result fields\n"
      "unless `set` gives output.vtk: true.\n\n",
      Level::debug);
}

}  // namespace bulbus::inline app
