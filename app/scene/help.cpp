#include "app/scene/help.hpp"

#include <fmt/format.h>

#include "app/scene/outline.hpp"
#include "app/study/study.hpp"

namespace bulbus {
namespace {

using Kind = Topic::Kind;

std::string plain_type(const Topic& t) {
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

std::string default_text(const Topic& t) {
  if (t.about.required) return ", needed";
  if (t.optional) return ", optional";
  if (t.kind == Kind::group) return "";
  std::string value = to_yaml(t.fallback);
  value.pop_back();  // the line's end
  return value == "\"\"" || value == "[]" || value == "{}" ? "" : ", default " + value;
}

std::string facts(const Topic& t) {
  const std::string unit = unit_of(t.about.quantity), bounds = bounds_text(t.about);
  return plain_type(t) + (unit.empty() ? "" : " in " + unit) + default_text(t) +
         (bounds.empty() ? "" : ", " + bounds);
}

const Topic& innermost(const Topic& t) {
  return t.kind == Kind::list || t.kind == Kind::map ? innermost(t.parts[0]) : t;
}

void write(const Topic& t, int indent, std::string& out) {
  const std::string words = t.about.choices.empty() ? "" : " (" + alternatives(t.about.choices) + ")";
  out +=
      fmt::format("{:<22}  {:<40}  {}{}\n", std::string(indent, ' ') + t.key, facts(t), t.about.help, words);
  for (const Topic& part : innermost(t).parts) write(part, indent + 2, out);
}

template <class T>
std::string help_of(std::string introduction) {
  for (const Topic& part : outline_of<T>("", About{""}).parts) write(part, 0, introduction);
  return introduction;
}

}  // namespace

std::string scene_help() {
  return help_of<Scene>(
      "A scene is a YAML file. Lengths in mm, forces in N, stresses in MPa, angles in rad; a value may carry "
      "its own\n"
      "unit (15 mmHg). A formula may use X, Y, Z (mm), s (0 to 1 over the step) and t (steps done + s).\n\n");
}

std::string study_help() {
  return help_of<Study>(
      "A study is a YAML file: a scene, and what to vary in it. Keys of the scene are paths such as\n"
      "steps.1.increments; entries of lists count from 0, or go by their name. Runs save no result fields\n"
      "unless `set` gives output.vtk: true.\n\n");
}

}  // namespace bulbus
