#pragma once
#include <algorithm>
#include <string_view>

#include "app/scene/entry.hpp"
#include "app/scene/kinds.hpp"
#include "core/base/error.hpp"

/// Reads an Entry into any struct that describes itself. Every fault is an InputError that names the place,
/// the key, the value and the remedy. `key` is the path of the value, such as `solver.linear.gamma`.
namespace bulbus::reader {

[[noreturn]] void refuse(const Entry& entry, const std::string& key, const std::string& what,
                         const std::string& remedy);
/// Refuses an entry of another kind.
void expect(const Entry& entry, Entry::Kind kind, const std::string& key);
/// Refuses the first key of a map that is not known.
void check_keys(const Entry& map, const std::string& key, const std::vector<std::string>& known);
[[noreturn]] void refuse_missing(const Entry& map, const std::string& key, const std::string& name,
                                 const About& about);

void read(const Entry& entry, const std::string& key, const About& about, bool& value);
void read(const Entry& entry, const std::string& key, const About& about, int& value);
void read(const Entry& entry, const std::string& key, const About& about, double& value);
void read(const Entry& entry, const std::string& key, const About& about, std::string& value);
void read(const Entry& entry, const std::string& key, const About& about, Point& value);

/// A member that takes any YAML.
inline void read(const Entry& entry, const std::string&, const About&, Entry& value) { value = entry; }

/// Refuses a word that is none of `choices`.
void check_choice(const Entry& entry, const std::string& key, const std::vector<std::string>& choices);

template <Worded E>
void read(const Entry& entry, const std::string& key, const About&, E& value) {
  expect(entry, Entry::Kind::word, key);
  check_choice(entry, key, all_words<E>());
  value = from_word<E>(entry.text);
}

template <class T>
void read_any(const Entry& entry, const std::string& key, const About& about, T& value);

inline std::string below(const std::string& key, const std::string& name) {
  return key.empty() ? name : key + "." + name;
}

/// Whether the object holds together, key by key right as it is.
template <kinds::Checked T>
void validate(const Entry& entry, const std::string& key, const T& object) {
  try {
    object.validate();
  } catch (const InputError& fault) {
    const std::string blamed = fault.key.empty() ? key : below(key, fault.key);
    const Place place = fault.key.empty() ? entry.place : place_of(entry, fault.key);
    throw input_error(place.file, place.line, (blamed.empty() ? "" : blamed + ": ") + fault.what(), "");
  }
}

/// Reads a map into a struct; keys that are not given keep their defaults.
template <kinds::Described T>
void read_struct(const Entry& entry, const std::string& key, T& object) {
  if (!entry.is(Entry::Kind::nothing)) expect(entry, Entry::Kind::map, key);
  check_keys(entry, key, kinds::keys_of(object));
  object.describe([&](const char* name, auto& member, const About& about) {
    const Entry* given = entry.find(name);
    if (about.required && (!given || given->is(Entry::Kind::nothing)))
      refuse_missing(entry, key, name, about);
    if (given) read_any(*given, below(key, name), about, member);
    if constexpr (kinds::Preset<T>)
      if (std::string_view(name) == T::preset_key) object.take_preset();
  });
  if constexpr (kinds::Checked<T>) validate(entry, key, object);
}

template <kinds::List T>
void read_list(const Entry& entry, const std::string& key, const About& about, T& list) {
  list.clear();
  if (entry.is(Entry::Kind::nothing)) return;
  expect(entry, Entry::Kind::list, key);
  for (const Entry& item : entry.items) {
    const std::string index = std::to_string(list.size());
    read_any(item, below(key, index), about, list.emplace_back());
  }
}

template <kinds::Map T>
void read_map(const Entry& entry, const std::string& key, const About& about, T& map) {
  map.clear();
  if (entry.is(Entry::Kind::nothing)) return;
  expect(entry, Entry::Kind::map, key);
  for (std::size_t i = 0; i < entry.items.size(); ++i)
    read_any(entry.items[i], below(key, entry.keys[i]), about, map[entry.keys[i]]);
}

// A struct that is optional and named without any content is wanted, with its defaults.
template <kinds::Optional T>
void read_optional(const Entry& entry, const std::string& key, const About& about, T& value) {
  value.reset();
  if (!entry.is(Entry::Kind::nothing) || kinds::Described<typename T::value_type>)
    read_any(entry, key, about, value.emplace());
  if constexpr (std::is_arithmetic_v<typename T::value_type>)
    if (about.zero_is_automatic && value == typename T::value_type{}) value.reset();
}

template <class T>
void read_any(const Entry& entry, const std::string& key, const About& about, T& value) {
  if constexpr (kinds::Described<T>)
    read_struct(entry, key, value);
  else if constexpr (kinds::List<T>)
    read_list(entry, key, about, value);
  else if constexpr (kinds::Map<T>)
    read_map(entry, key, about, value);
  else if constexpr (kinds::Optional<T>)
    read_optional(entry, key, about, value);
  else
    read(entry, key, about, value);
}

}  // namespace bulbus::reader
