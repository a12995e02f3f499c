#include <algorithm>

#include "app/scene/reader.hpp"

namespace bulbus::inline app::reader {
namespace {

void read_word(const YamlNode& entry, const std::string& key, const Value& value) {
  expect(entry, YamlNode::Kind::word, key);
  check_choice(entry, key, value.words());
  value.choose(entry.text);
}

// Whether the struct holds together, key by key right as it is.
void validate(const YamlNode& entry, const std::string& key, const Value& group) {
  try {
    group.validate();
  } catch (const InputError& fault) {
    const std::string blamed = fault.key.empty() ? key : below(key, fault.key);
    const Place place = fault.key.empty() ? entry.place : place_of(entry, fault.key);
    throw input_error(place.file, place.line, (blamed.empty() ? "" : blamed + ": ") + fault.what(), "");
  }
}

void check_members(const YamlNode& map, const std::string& key, const std::vector<Member>& members) {
  std::vector<std::string> keys;
  for (const Member& m : members) {
    keys.push_back(m.key);
    if (!m.about.former.empty()) refuse_former(map, key, m.about.former, m.key);
  }
  check_keys(map, key, keys);
}

void read_group(const YamlNode& entry, const std::string& key, const Value& group) {
  if (!entry.is(YamlNode::Kind::nothing)) expect(entry, YamlNode::Kind::map, key);
  const std::vector<Member> members = group.members();
  check_members(entry, key, members);
  for (const Member& m : members) {
    const YamlNode* given = entry.find(m.key);
    if (m.about.required && (!given || given->is(YamlNode::Kind::nothing)))
      refuse_missing(entry, key, m.key, m.about);
    if (given) read(*given, below(key, m.key), m.about, m.value);
    if (group.preset_key() && m.key == group.preset_key()) group.take_preset();
  }
  validate(entry, key, group);
}

void read_list(const YamlNode& entry, const std::string& key, const About& about, const Value& list) {
  list.clear();
  if (entry.is(YamlNode::Kind::nothing)) return;
  expect(entry, YamlNode::Kind::list, key);
  for (std::size_t i = 0; i < entry.items.size(); ++i)
    read(entry.items[i], below(key, std::to_string(i)), about, list.add());
}

void read_map(const YamlNode& entry, const std::string& key, const About& about, const Value& map) {
  map.clear();
  if (entry.is(YamlNode::Kind::nothing)) return;
  expect(entry, YamlNode::Kind::map, key);
  for (std::size_t i = 0; i < entry.items.size(); ++i) {
    check_name(entry.key_places[i], key, entry.keys[i]);
    read(entry.items[i], below(key, entry.keys[i]), about, map.add(entry.keys[i]));
  }
}

bool is_zero(const Value& value) {
  return (value.kind() == Value::Kind::integer && value.as<int>() == 0) ||
         (value.kind() == Value::Kind::number && value.as<double>() == 0);
}

// A struct that is optional and named without any content is wanted, with its defaults.
void read_optional(const YamlNode& entry, const std::string& key, const About& about, const Value& value) {
  value.clear();
  if (entry.is(YamlNode::Kind::nothing) && value.inner_kind() != Value::Kind::group) return;
  const Value inner = value.add();
  read(entry, key, about, inner);
  if (about.zero_is_automatic && is_zero(inner)) value.clear();
}

}  // namespace

std::string below(const std::string& key, const std::string& name) {
  return key.empty() ? name : key + "." + name;
}

void read(const YamlNode& entry, const std::string& key, const About& about, const Value& value) {
  switch (value.kind()) {
    case Value::Kind::truth:
      return read(entry, key, about, value.as<bool>());
    case Value::Kind::integer:
      return read(entry, key, about, value.as<int>());
    case Value::Kind::number:
      return read(entry, key, about, value.as<double>());
    case Value::Kind::text:
      return read(entry, key, about, value.as<std::string>());
    case Value::Kind::point:
      return read(entry, key, about, value.as<Point>());
    case Value::Kind::word:
      return read_word(entry, key, value);
    case Value::Kind::optional:
      return read_optional(entry, key, about, value);
    case Value::Kind::list:
      return read_list(entry, key, about, value);
    case Value::Kind::map:
      return read_map(entry, key, about, value);
    case Value::Kind::group:
      return read_group(entry, key, value);
    case Value::Kind::any:
      value.as<YamlNode>() = entry;
  }
}

void read(const YamlNode& root, const Value& group) { read(root, "", About{""}, group); }

}  // namespace bulbus::inline app::reader
