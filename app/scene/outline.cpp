#include "app/scene/outline.hpp"

#include <algorithm>

#include "app/scene/writer.hpp"

namespace bulbus {
namespace {

using Kind = Topic::Kind;

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

std::vector<Topic> parts_of(const Value& group) {
  std::vector<Topic> parts;
  for (const Member& m : group.members()) {
    Entry fallback = entry_of(m.value, m.about);
    parts.push_back(outline_of(m.key, m.about, m.value));
    parts.back().fallback = std::move(fallback);
  }
  return parts;
}

// Gives all that is below a topic the topic's level and conditions.
void inherit(Topic& topic, const About& about) {
  for (Topic& part : topic.parts) {
    part.about.level = std::max(part.about.level, about.level);
    part.about.conditions.insert(part.about.conditions.begin(), about.conditions.begin(),
                                 about.conditions.end());
    inherit(part, about);
  }
}

}  // namespace

Topic outline_of(const std::string& key, const About& about, const Value& value) {
  if (value.kind() == Value::Kind::optional) {
    Topic topic = outline_of(key, about, value.add());
    topic.optional = !about.zero_is_automatic;
    return topic;
  }
  Topic topic{.key = key, .about = about, .kind = kind_of(value.kind())};
  if (value.kind() == Value::Kind::word) topic.about.choices = value.words();
  if (topic.kind == Kind::list || topic.kind == Kind::map) topic.parts = {outline_of("", about, value.add())};
  if (topic.kind == Kind::group) {
    topic.parts = parts_of(value);
    inherit(topic, about);
  }
  return topic;
}

}  // namespace bulbus
