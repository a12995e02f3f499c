#include "app/scene/writer.hpp"

#include "app/scene/text_format.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline app {
namespace {

YamlNode entry_of_group(const Value& group) {
  YamlNode map = YamlNode::empty(YamlNode::Kind::map);
  for (const Member& m : group.members()) {
    YamlNode entry = entry_of(m.value, m.about);
    if (!entry.is(YamlNode::Kind::nothing)) map.insert(m.key, {}, std::move(entry));
  }
  return map;
}

YamlNode entry_of_optional(const Value& value, const About& about) {
  const auto items = value.items();
  return !items.empty()            ? entry_of(items[0].second, about)
         : about.zero_is_automatic ? YamlNode::word("0")
                                   : YamlNode::empty(YamlNode::Kind::nothing);
}

YamlNode entry_of_map(const Value& value, const About& about) {
  YamlNode map = YamlNode::empty(YamlNode::Kind::map);
  for (const auto& [key, item] : value.items()) map.insert(key, {}, entry_of(item, about));
  return map;
}

YamlNode entry_of_list(const Value& value, const About& about) {
  YamlNode list = YamlNode::empty(YamlNode::Kind::list);
  for (const auto& [key, item] : value.items()) list.items.push_back(entry_of(item, about));
  return list;
}

YamlNode entry_of_number(double value, const About& about) {
  YamlNode entry = YamlNode::word(number_text(value));
  entry.note = unit_of(about.quantity);
  return entry;
}

YamlNode entry_of_point(const Point& point, const About& about) {
  YamlNode list = YamlNode::empty(YamlNode::Kind::list);
  for (const double x : point) list.items.push_back(entry_of_number(x, about));
  return list;
}

// Without its unit, which stands behind lists too.
YamlNode bare_entry_of(const Value& value, const About& about) {
  switch (value.kind()) {
    case Value::Kind::list:
      return entry_of_list(value, about);
    case Value::Kind::point:
      return entry_of_point(value.as<Point>(), about);
    case Value::Kind::truth:
      return YamlNode::word(value.as<bool>() ? "true" : "false");
    case Value::Kind::integer:
      return YamlNode::word(std::to_string(value.as<int>()));
    case Value::Kind::number:
      return YamlNode::word(number_text(value.as<double>()));
    case Value::Kind::word:
      return YamlNode::word(value.word());
    default:
      return YamlNode::word(value.as<std::string>());
  }
}

}  // namespace

YamlNode entry_of(const Value& value, const About& about) {
  switch (value.kind()) {
    case Value::Kind::group:
      return entry_of_group(value);
    case Value::Kind::optional:
      return entry_of_optional(value, about);
    case Value::Kind::map:
      return entry_of_map(value, about);
    case Value::Kind::any:
      return value.as<YamlNode>();
    default:
      break;
  }
  YamlNode entry = bare_entry_of(value, about);
  entry.note = unit_of(about.quantity);
  return entry;
}

}  // namespace bulbus::inline app
