#include <cmath>
#include <nlohmann/json.hpp>

#include "app/scene/help.hpp"
#include "app/scene/schema_tree.hpp"
#include "app/scene/text_format.hpp"
#include "app/study/study.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;
using Kind = SchemaNode::Kind;

json schema_of(const SchemaNode& t);

json number_schema(const SchemaNode& t, const char* type) {
  json s{{"type", type}};
  if (t.about.quantity != Quantity::number) s["type"] = {type, "string"};  // "15 mmHg"
  if (std::isfinite(t.about.low)) s[t.about.above ? "exclusiveMinimum" : "minimum"] = t.about.low;
  if (std::isfinite(t.about.high)) s["maximum"] = t.about.high;
  return s;
}

json text_schema(const SchemaNode& t) {
  if (t.about.formula) return {{"type", {"number", "string"}}};
  json s{{"type", {"string", "number"}}};  // a name may look like a number
  if (!t.about.choices.empty()) s = {{"type", "string"}, {"enum", t.about.choices}};
  return s;
}

json point_schema(const SchemaNode& t) {
  return {{"type", "array"}, {"items", number_schema(t, "number")}, {"minItems", 3}, {"maxItems", 3}};
}

json group_schema(const SchemaNode& t) {
  json s{{"type", "object"}, {"additionalProperties", false}, {"properties", json::object()}};
  for (const SchemaNode& part : t.parts) {
    s["properties"][part.key] = schema_of(part);
    if (part.about.required) s["required"].push_back(part.key);
  }
  return s;
}

json shape_of(const SchemaNode& t) {
  switch (t.kind) {
    case Kind::truth:
      return {{"type", "boolean"}};
    case Kind::integer:
      return number_schema(t, "integer");
    case Kind::number:
      return number_schema(t, "number");
    case Kind::point:
      return point_schema(t);
    case Kind::group:
      return group_schema(t);
    case Kind::list:
      return {{"type", "array"}, {"items", shape_of(t.parts[0])}};
    case Kind::map:
      return {{"type", "object"}, {"additionalProperties", shape_of(t.parts[0])}};
    case Kind::any:
      return json::object();
    default:
      return text_schema(t);
  }
}

json value_of(const YamlNode& e, Kind kind) {
  json list = json::array();
  if (e.is(YamlNode::Kind::list)) {
    for (const YamlNode& item : e.items) list.push_back(value_of(item, kind));
    return list;
  }
  if (kind == Kind::truth) return e.text == "true";
  if (kind == Kind::integer) return std::stoi(e.text);
  return kind == Kind::number ? json(std::stod(e.text)) : json(e.text);
}

json default_of(const SchemaNode& t) {
  if (t.kind == Kind::map) return json::object();
  if (t.kind == Kind::point) return value_of(t.fallback, Kind::number);
  return value_of(t.fallback, t.kind == Kind::list ? t.parts[0].kind : t.kind);
}

json schema_of(const SchemaNode& t) {
  json s = shape_of(t);
  const std::string unit = unit_of(t.about.quantity);
  const std::string level = t.about.level == Level::everyday ? "" : " (" + word_of(t.about.level) + ")";
  s["description"] =
      t.about.help + (unit.empty() ? "" : " [" + unit + "]") + conditions_text(t.about.conditions) + level;
  if (!t.about.required && !t.optional && t.kind != Kind::group) s["default"] = default_of(t);
  return s;
}

SchemaNode tree_of(const Value& parameters) { return schema_tree_of("", About{""}, parameters); }

json root_schema(const SchemaNode& root, const char* title) {
  json s = shape_of(root);
  s["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  s["title"] = title;
  return s;
}

}  // namespace

nlohmann::json scene_schema() {
  Scene defaults;
  const SchemaNode scene = tree_of(parameters_of(defaults));
  json s = root_schema(scene, "Bulbus scene");
  json& sources = s["properties"]["mesh"]["oneOf"];
  const auto mesh = std::ranges::find(scene.parts, "mesh", &SchemaNode::key);
  for (const SchemaNode& part : mesh->parts)
    if (part.optional) sources.push_back(json{{"required", json::array({part.key})}});
  return s;
}

nlohmann::json study_schema() {
  Study defaults;
  return root_schema(tree_of(parameters_of(defaults)), "Bulbus study");
}

}  // namespace bulbus::inline app
