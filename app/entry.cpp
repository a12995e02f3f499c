#include "app/entry.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/error.hpp"

namespace bulbus {
namespace {

constexpr int deepest = 64;  // an alias inside its own anchor would nest for ever

struct Source {
  std::string name;
  bool has_lines;

  Place at(const YAML::Mark& mark) const { return {name, has_lines && !mark.is_null() ? mark.line + 1 : 0}; }
};

Entry convert(const YAML::Node& node, const Source& source, int depth);

Entry convert_list(const YAML::Node& node, const Source& source, int depth) {
  Entry list = Entry::empty(Entry::Kind::list, source.at(node.Mark()));
  for (const YAML::Node& item : node) list.items.push_back(convert(item, source, depth + 1));
  return list;
}

// The merge key of YAML, `<<: *name`: what the map does not say itself comes from another map, or from the first of several.
void merge(Entry& map, const Entry& from, const Source& source) {
  if (from.is(Entry::Kind::list)) {
    for (const Entry& one : from.items) merge(map, one, source);
    return;
  }
  if (!from.is(Entry::Kind::map))
    throw input_error(source.name, from.place.line, "the merge key '<<' has no map", "write `<<: *name` with the anchor &name at a map, or a list of such");
  for (std::size_t i = 0; i < from.keys.size(); ++i)
    if (!map.find(from.keys[i])) map.insert(from.keys[i], from.key_places[i], from.items[i]);
}

Entry convert_map(const YAML::Node& node, const Source& source, int depth) {
  Entry map = Entry::empty(Entry::Kind::map, source.at(node.Mark()));
  std::vector<Entry> merged;
  for (const auto& pair : node) {
    const Place place = source.at(pair.first.Mark());
    if (!pair.first.IsScalar()) throw input_error(source.name, place.line, "a key must be a word", "");
    const std::string key = pair.first.Scalar();
    if (map.find(key))
      throw input_error(source.name, place.line, "the key '" + key + "' is given twice",
                        "it stands in line " +
                            std::to_string(map.key_places[map.find(key) - map.items.data()].line) +
                            " already; keep one of the two");
    Entry value = convert(pair.second, source, depth + 1);
    if (value.place.line == 0) value.place = place;
    if (key == "<<") {
      merged.push_back(std::move(value));
      continue;
    }
    map.insert(key, place, std::move(value));
  }
  for (const Entry& from : merged) merge(map, from, source);
  return map;
}

Entry convert(const YAML::Node& node, const Source& source, int depth) {
  if (depth > deepest)
    throw input_error(source.name, source.at(node.Mark()).line, "nested too deeply",
                      "an alias (*name) must not stand inside its own anchor (&name)");
  if (node.IsMap()) return convert_map(node, source, depth);
  if (node.IsSequence()) return convert_list(node, source, depth);
  const Place place = source.at(node.Mark());
  return node.IsScalar() ? Entry::word(node.Scalar(), place) : Entry::empty(Entry::Kind::nothing, place);
}

}  // namespace

const Entry* Entry::find(const std::string& key) const {
  auto at = std::find(keys.begin(), keys.end(), key);
  return at == keys.end() ? nullptr : &items[at - keys.begin()];
}

Entry* Entry::find(const std::string& key) {
  return const_cast<Entry*>(static_cast<const Entry*>(this)->find(key));
}

Entry& Entry::insert(const std::string& key, Place key_place, Entry value) {
  keys.push_back(key);
  key_places.push_back(std::move(key_place));
  return items.emplace_back(std::move(value));
}

Entry Entry::word(std::string text, Place place) {
  Entry e = empty(Kind::word, std::move(place));
  e.text = std::move(text);
  return e;
}

Entry Entry::empty(Kind kind, Place place) {
  Entry e;
  e.kind = kind;
  e.place = std::move(place);
  return e;
}

namespace {

Entry parse(const std::string& text, const Source& source) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1)
      throw input_error(source.name, 0, "holds more than one YAML document",
                        "remove the lines '---' between them");
    return documents.empty() ? Entry::empty(Entry::Kind::nothing, {source.name, 0})
                             : convert(documents[0], source, 0);
  } catch (const YAML::Exception& fault) {
    throw input_error(source.name, source.at(fault.mark).line, "not valid YAML: " + fault.msg,
                      "look at the indentation, colons, quotes and brackets here and just above");
  }
}

}  // namespace

Entry parse_yaml(const std::string& text, const std::string& file) { return parse(text, {file, true}); }

Entry read_yaml(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw input_error(path, 0, "cannot be read", "check the name of the file");
  return parse_yaml({std::istreambuf_iterator<char>(in), {}}, path);
}

Entry parse_word(const std::string& text, const std::string& place) { return parse(text, {place, false}); }

}  // namespace bulbus
