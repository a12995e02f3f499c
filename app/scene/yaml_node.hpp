#pragma once
#include <string>
#include <vector>

namespace bulbus::inline app {

/// Where a value was written: `file:line`, or the `--set` that gave it.
struct Place {
  std::string file;
  int line = 0;  ///< 0: not in a file
};

/// A YAML document as plain data: words keep their text, every entry knows its place.
struct YamlNode {
  enum class Kind { nothing, word, list, map };
  Kind kind = Kind::nothing;
  Place place;                    ///< of the value
  std::string text;               ///< of a word
  std::vector<YamlNode> items;    ///< of a list or a map
  std::vector<std::string> keys;  ///< of a map, one per item
  std::vector<Place> key_places;  ///< of a map, one per item
  std::string note;               ///< written behind a word as a comment; never read

  const YamlNode* find(const std::string& key) const;
  YamlNode* find(const std::string& key);
  /// Appends an item to a map.
  YamlNode& insert(const std::string& key, Place key_place, YamlNode value);
  bool is(Kind k) const { return kind == k; }

  static YamlNode word(std::string text, Place place = {});
  static YamlNode empty(Kind kind, Place place = {});
};

/// Reads YAML from text. Throws InputError with the line at a fault of syntax or a key given twice; `file` is
/// the name in messages.
YamlNode parse_yaml(const std::string& text, const std::string& file);
/// Reads a YAML file. Throws InputError, also if there is no such file.
YamlNode read_yaml(const std::string& path);
/// The same for YAML that comes from no file: `place` is the name in messages, which give no line.
YamlNode parse_word(const std::string& text, const std::string& place);

/// Writes YAML that parse_yaml reads back, notes as comments.
std::string to_yaml(const YamlNode& map);

/// Puts `value` at `path.to.key`: a map is entered by key, a list by index (from 0) or by the `name` (else
/// the `set` or the `body`) of its entries. Missing keys of maps are added, so that the reader can judge
/// them. `place` is where the path is written. Returns the path with numbers in place of names. Throws
/// InputError if a list has no such entry, or several.
std::string set_at(YamlNode& root, const std::string& path, const Place& place, YamlNode value);

/// Applies `path.to.key=value`; the value is YAML. Returns what set_at returns. Throws InputError if the text
/// has no `=`, or as set_at does.
std::string apply_override(YamlNode& root, const std::string& assignment);

/// Where `path.to.key` is written, a list entered by index; where a part of the path is not written, what is
/// around it.
Place place_of(const YamlNode& root, const std::string& path);

}  // namespace bulbus::inline app
