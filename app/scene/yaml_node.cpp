#include "app/scene/yaml_node.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unordered_map>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"

namespace bulbus::inline app {
namespace {

constexpr int deepest = 64;                  // an alias inside its own anchor would nest for ever
constexpr std::size_t most_bytes = 4 << 20;  // a scene is a few kilobytes
constexpr std::size_t most_values = 200000;  // aliases of aliases multiply

struct Source {
  std::string name;
  bool has_lines;

  Place at(const YAML::Mark& mark) const { return {name, has_lines && !mark.is_null() ? mark.line + 1 : 0}; }
};

// Makes plain data of the nodes, aliases written out.
class Converter {
 public:
  explicit Converter(const Source& source) : source_(source) {}

  YamlNode convert(const YAML::Node& node, int depth) {
    const Place place = source_.at(node.Mark());
    if (depth > deepest)
      throw input_error(place.file, place.line, "nested too deeply",
                        "an alias (*name) must not stand inside its own anchor (&name)");
    count(1, place);
    if (node.IsMap()) return convert_map(node, place, depth);
    if (node.IsSequence()) return convert_list(node, place, depth);
    return node.IsScalar() ? YamlNode::word(whole(node.Scalar(), place), place)
                           : YamlNode::empty(YamlNode::Kind::nothing, place);
  }

 private:
  // Messages and names of files would end there.
  static std::string whole(const std::string& word, const Place& place) {
    if (word.find('\0') != std::string::npos)
      throw input_error(place.file, place.line, "'" + printable(word, true) + "' has a character of code 0",
                        "write it again without: editors hide such characters");
    return word;
  }

  void count(std::size_t more, const Place& place) {
    values_ += more;
    if (values_ > most_values)
      throw input_error(place.file, place.line,
                        fmt::format("with its aliases written out it has more than {} values", most_values),
                        "let aliases (*name) not stand for lists or maps of further aliases, and keep meshes "
                        "and tables in files of their own");
  }

  YamlNode convert_list(const YAML::Node& node, const Place& place, int depth) {
    YamlNode list = YamlNode::empty(YamlNode::Kind::list, place);
    for (const YAML::Node& item : node) list.items.push_back(convert(item, depth + 1));
    return list;
  }

  YamlNode convert_map(const YAML::Node& node, const Place& place, int depth) {
    YamlNode map = YamlNode::empty(YamlNode::Kind::map, place);
    std::unordered_map<std::string, int> lines;  // of the keys so far
    std::vector<YamlNode> merged;
    for (const auto& pair : node) {
      const Place at = source_.at(pair.first.Mark());
      if (!pair.first.IsScalar())
        throw input_error(at.file, at.line, "a key must be a word",
                          "write `key: value`, and put words with brackets or braces in quotes");
      const std::string key = whole(pair.first.Scalar(), at);
      if (const auto [first, fresh] = lines.emplace(key, at.line); !fresh)
        throw input_error(
            at.file, at.line, "the key '" + printable(key, true) + "' is given twice",
            "it stands in line " + std::to_string(first->second) + " already; keep one of the two");
      YamlNode value = convert(pair.second, depth + 1);
      if (value.place.line == 0) value.place = at;
      if (key == "<<")
        merged.push_back(std::move(value));
      else
        map.insert(key, at, std::move(value));
    }
    for (const YamlNode& from : merged) merge(map, from, lines);
    return map;
  }

  // The merge key of YAML, `<<: *name`: what the map does not say itself comes from another map, or from the
  // first of several.
  void merge(YamlNode& map, const YamlNode& from, std::unordered_map<std::string, int>& lines) {
    if (from.is(YamlNode::Kind::list)) {
      for (const YamlNode& one : from.items) merge(map, one, lines);
      return;
    }
    if (!from.is(YamlNode::Kind::map))
      throw input_error(source_.name, from.place.line, "the merge key '<<' has no map",
                        "write `<<: *name` with the anchor &name at a map, or a list of such");
    for (std::size_t i = 0; i < from.keys.size(); ++i)
      if (lines.emplace(from.keys[i], from.key_places[i].line).second)
        map.insert(from.keys[i], from.key_places[i], from.items[i]);
  }

  const Source& source_;
  std::size_t values_ = 0;
};

}  // namespace

const YamlNode* YamlNode::find(const std::string& key) const {
  auto at = std::find(keys.begin(), keys.end(), key);
  return at == keys.end() ? nullptr : &items[at - keys.begin()];
}

YamlNode* YamlNode::find(const std::string& key) {
  return const_cast<YamlNode*>(static_cast<const YamlNode*>(this)->find(key));
}

YamlNode& YamlNode::insert(const std::string& key, Place key_place, YamlNode value) {
  keys.push_back(key);
  key_places.push_back(std::move(key_place));
  return items.emplace_back(std::move(value));
}

YamlNode YamlNode::word(std::string text, Place place) {
  YamlNode e = empty(Kind::word, std::move(place));
  e.text = std::move(text);
  return e;
}

YamlNode YamlNode::empty(Kind kind, Place place) {
  YamlNode e;
  e.kind = kind;
  e.place = std::move(place);
  return e;
}

namespace {

YamlNode parse(const std::string& text, const Source& source) {
  if (text.size() > most_bytes)
    throw input_error(source.name, 0, fmt::format("has more than {} MB: that is no scene", most_bytes >> 20),
                      "check the name of the file; meshes and bodies are files of their own");
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1)
      throw input_error(source.name, source.at(documents[1].Mark()).line,
                        "a second YAML document begins here", "remove the lines '---' between them");
    return documents.empty() ? YamlNode::empty(YamlNode::Kind::nothing, {source.name, 0})
                             : Converter(source).convert(documents[0], 0);
  } catch (const YAML::Exception& fault) {
    throw input_error(source.name, source.at(fault.mark).line, "not valid YAML: " + fault.msg,
                      "look at the indentation, colons, quotes and brackets here and just above");
  }
}

}  // namespace

YamlNode parse_yaml(const std::string& text, const std::string& file) { return parse(text, {file, true}); }

YamlNode read_yaml(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw input_error(path, 0, "cannot be read", "check the name of the file");
  std::string text(most_bytes + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse_yaml(text, path);
}

YamlNode parse_word(const std::string& text, const std::string& place) { return parse(text, {place, false}); }

}  // namespace bulbus::inline app
