#include <algorithm>
#include <charconv>

#include "app/scene/yaml_node.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"

namespace bulbus::inline app {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts{""};
  for (char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::string name_of(const YamlNode& item) {
  for (const char* key : {"name", "set", "body"})
    if (const YamlNode* name = item.find(key); name && name->is(YamlNode::Kind::word)) return name->text;
  return "";
}

// The number of the entry that has this number or this name.
std::size_t in_list(const YamlNode& list, const std::string& part, const Place& place) {
  const auto index = parse_number<std::size_t>(part);
  std::vector<std::string> names;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    names.push_back(name_of(list.items[i]));
    if (index == i || names[i] == part) found.push_back(i);
  }
  if (found.size() == 1) return found[0];
  if (!found.empty())
    throw input_error(place.file, place.line,
                      "'" + part + "' is entry " + std::to_string(found[0]) + " and entry " +
                          std::to_string(found[1]) + " of a list, by number or by name",
                      index ? "give the entry another name" : "give its number, counted from 0");
  if (index) names.clear();
  throw input_error(place.file, place.line,
                    "no entry '" + part + "' in a list of " + std::to_string(list.items.size()),
                    did_you_mean(part, names, "entries count from 0, or go by their name"));
}

// A word or nothing on the way becomes a map: the reader then says whether a map may stand there.
YamlNode& in_map(YamlNode& entry, const std::string& part, const Place& place) {
  if (!entry.is(YamlNode::Kind::map)) entry = YamlNode::empty(YamlNode::Kind::map, place);
  if (YamlNode* known = entry.find(part)) return *known;
  return entry.insert(part, place, YamlNode::empty(YamlNode::Kind::nothing, place));
}

}  // namespace

Place place_of(const YamlNode& root, const std::string& path) {
  const YamlNode* at = &root;
  Place place = root.place;
  for (const std::string& part : split(path)) {
    std::size_t index = at->items.size();
    if (at->is(YamlNode::Kind::map))
      index = std::find(at->keys.begin(), at->keys.end(), part) - at->keys.begin();
    else if (at->is(YamlNode::Kind::list))
      std::from_chars(part.data(), part.data() + part.size(), index);
    if (index >= at->items.size()) break;
    place = at->is(YamlNode::Kind::map) ? at->key_places[index] : at->items[index].place;
    at = &at->items[index];
    if (at->place.file != place.file)
      place = at->place;  // an override, or a study: it stands behind the key of the scene
  }
  return place;
}

std::string set_at(YamlNode& root, const std::string& path, const Place& place, YamlNode value) {
  YamlNode* at = &root;
  std::string by_numbers;
  for (const std::string& part : split(path)) {
    if (part.empty())
      throw input_error(place.file, place.line, "an empty name in the path '" + path + "'",
                        "write path.to.key");
    by_numbers += by_numbers.empty() ? "" : ".";
    if (at->is(YamlNode::Kind::list)) {
      const std::size_t index = in_list(*at, part, place);
      by_numbers += std::to_string(index);
      at = &at->items[index];
    } else {
      by_numbers += part;
      at = &in_map(*at, part, place);
    }
  }
  *at = std::move(value);
  return by_numbers;
}

std::string apply_override(YamlNode& root, const std::string& assignment) {
  // every value that it gives keeps the place
  constexpr std::size_t shown = 200;
  const Place place{
      "--set " + (assignment.size() > shown ? assignment.substr(0, shown) + " ..." : assignment), 0};
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw input_error(place.file, 0, "not of the form path.to.key=value",
                      "such as --set steps.0.increments=4");
  const std::string value = assignment.substr(equals + 1);
  return set_at(root, assignment.substr(0, equals), place,
                value.empty() ? YamlNode::word("", place) : parse_word(value, place.file));
}

}  // namespace bulbus::inline app
