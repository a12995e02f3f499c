#pragma once
#include <string>
#include <vector>

namespace bulbus {

/// Where a value was written: `file:line`, or the `--set` that gave it.
struct Place {
  std::string file;
  int line = 0;  ///< 0: not in a file
};

/// A YAML document as plain data: words keep their text, every entry knows its place.
struct Entry {
  enum class Kind { nothing, word, list, map };
  Kind kind = Kind::nothing;
  Place place;                    ///< of the value
  std::string text;               ///< of a word
  std::vector<Entry> items;       ///< of a list or a map
  std::vector<std::string> keys;  ///< of a map, one per item
  std::vector<Place> key_places;  ///< of a map, one per item
  std::string note;               ///< written behind a word as a comment; never read

  const Entry* find(const std::string& key) const;
  Entry* find(const std::string& key);
  /// Appends an item to a map.
  Entry& insert(const std::string& key, Place key_place, Entry value);
  bool is(Kind k) const { return kind == k; }

  static Entry word(std::string text, Place place = {});
  static Entry empty(Kind kind, Place place = {});
};

/// Reads YAML from text. Throws InputError with the line at a fault of syntax or a key given twice; `file` is
/// the name in messages.
Entry parse_yaml(const std::string& text, const std::string& file);
/// Reads a YAML file. Throws InputError, also if there is no such file.
Entry read_yaml(const std::string& path);
/// The same for YAML that comes from no file: `place` is the name in messages, which give no line.
Entry parse_word(const std::string& text, const std::string& place);

/// Writes YAML that parse_yaml reads back, notes as comments.
std::string to_yaml(const Entry& map);

/// Puts `value` at `path.to.key`: a map is entered by key, a list by index (from 0) or by the `name` (else
/// the `set` or the `body`) of its entries. Missing keys of maps are added, so that the reader can judge
/// them. `place` is where the path is written. Throws InputError if a list has no such entry.
void set_at(Entry& root, const std::string& path, const Place& place, Entry value);

/// Applies `path.to.key=value`; the value is YAML. Throws InputError if the text has no `=`, or as set_at
/// does.
void apply_override(Entry& root, const std::string& assignment);

/// Where `path.to.key` is written, a list entered by index; where a part of the path is not written, what is
/// around it.
Place place_of(const Entry& root, const std::string& path);

}  // namespace bulbus
