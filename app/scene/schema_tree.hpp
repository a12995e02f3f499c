#pragma once
#include <string>
#include <vector>

#include "app/scene/value.hpp"
#include "app/scene/yaml_node.hpp"

namespace bulbus::inline app {

/// What may be written at one place of a scene: the common source of the help and of the schema.
struct SchemaNode {
  enum class Kind { truth, integer, number, text, point, group, list, map, any };
  std::string key;
  About about{""};
  Kind kind = Kind::text;
  bool optional = false;          ///< may be left out without a default taking its place
  YamlNode fallback;              ///< the default
  std::vector<SchemaNode> parts;  ///< the keys of a group; the one entry of a list or map
};

/// The outline of `value`, which holds the defaults; what is optional in it, and its lists and maps, are
/// overwritten.
SchemaNode schema_tree_of(const std::string& key, const About& about, const Value& value);

}  // namespace bulbus::inline app
