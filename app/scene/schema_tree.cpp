#include "app/scene/schema_tree.hpp"

#include <algorithm>

#include "app/scene/writer.hpp"

namespace bulbus::inline app {
namespace {

using Kind = SchemaNode::Kind;

Kind kind_of(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::truth:
      return Kind::truth;
    case Value::Kind::integer:
      return Kind::integer;
    case Value::Kind::number:
      return Kind::number;
    case Value::Kind::point:
      return Kind::point;
    case Value::Kind::group:
      return Kind::group;
    case Value::Kind::list:
      return Kind::list;
    case Value::Kind::map:
      return Kind::map;
    case Value::Kind::any:
      return Kind::any;
    default:
      return Kind::text;
  }
}

std::vector<SchemaNode> parts_of(const Value& group) {
  std::vector<SchemaNode> parts;
  for (const Member& m : group.members()) {
    YamlNode fallback = entry_of(m.value, m.about);
    parts.push_back(schema_tree_of(m.key, m.about, m.value));
    parts.back().fallback = std::move(fallback);
  }
  return parts;
}

// Gives all that is below a topic the topic's level and conditions.
void inherit(SchemaNode& topic, const About& about) {
  for (SchemaNode& part : topic.parts) {
    part.about.level = std::max(part.about.level, about.level);
    part.about.conditions.insert(part.about.conditions.begin(), about.conditions.begin(),
                                 about.conditions.end());
    inherit(part, about);
  }
}

}  // namespace

SchemaNode schema_tree_of(const std::string& key, const About& about, const Value& value) {
  if (value.kind() == Value::Kind::optional) {
    SchemaNode topic = schema_tree_of(key, about, value.add());
    topic.optional = !about.zero_is_automatic;
    return topic;
  }
  SchemaNode topic{.key = key, .about = about, .kind = kind_of(value.kind())};
  if (value.kind() == Value::Kind::word) topic.about.choices = value.words();
  if (topic.kind == Kind::list || topic.kind == Kind::map)
    topic.parts = {schema_tree_of("", about, value.add())};
  if (topic.kind == Kind::group) {
    topic.parts = parts_of(value);
    inherit(topic, about);
  }
  return topic;
}

}  // namespace bulbus::inline app
