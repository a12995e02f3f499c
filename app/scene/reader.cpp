#include "app/scene/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <numbers>

#include "app/scene/text_format.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"

namespace bulbus::inline app::reader {
namespace {

constexpr double largest = 1e100,
                 least = 1e-100;  // squares of numbers beyond are infinite or zero: directions would vanish
constexpr double most_radians =
    4 * std::numbers::pi;  // without a unit: two turns in one step are rather a slip

std::string name_of(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::nothing:
      return "nothing";
    case YamlNode::Kind::word:
      return "a single value";
    case YamlNode::Kind::list:
      return "a list";
    default:
      return "a map";
  }
}

// A value as messages show it: in quotes, cut where it is long.
std::string shown(const YamlNode& entry) {
  return "'" + (entry.text.size() > 60 ? entry.text.substr(0, 60) + "..." : entry.text) + "'";
}

std::string example_of(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::list:
      return "write [a, b], or one line '- ...' for each entry";
    case YamlNode::Kind::map:
      return "write 'key: value' lines below it, further indented";
    default:
      return "write one value behind the colon";
  }
}

void check_bounds(const YamlNode& entry, const std::string& key, const About& about, double value) {
  const bool low = about.above ? value > about.low : value >= about.low;
  if (!low || value > about.high)
    refuse(entry, key, shown(entry) + " is out of bounds", "give " + wanted_number(about));
}

// A number and a word are never an expression: "15 mmhg" is a slip in the unit.
bool looks_like_quantity(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos || !std::strchr("+-.0123456789", text[first])) return false;
  char* end = nullptr;
  std::strtod(text.c_str() + first, &end);
  return end != text.c_str() + first && !std::strpbrk(end, "+-*/^()<>=?:,&|!");
}

// A number without its unit.
bool is_bare(const std::string& text) {
  const auto last = text.find_last_not_of(" \t");
  return last != std::string::npos &&
         (std::isdigit(static_cast<unsigned char>(text[last])) || text[last] == '.');
}

// A number comes out in kept units, with their name where the scene names a unit: only a bare number may be a
// slip in the unit.
std::string read_formula(const YamlNode& entry, const std::string& key, const About& about) {
  if (!looks_like_quantity(entry.text)) return entry.text;
  double value = 0;
  read(entry, key, about, value);
  return number_text(value) +
         (is_bare(entry.text) || unit_of(about.quantity).empty() ? "" : " " + unit_of(about.quantity));
}

// For a key that belongs into a map beside it: rigid_bodies.NAME.width, where band.width is meant.
std::string one_level_below(const YamlNode& map, const std::string& key,
                            const std::vector<std::string>& known) {
  for (std::size_t i = 0; i < map.items.size(); ++i)
    if (map.items[i].is(YamlNode::Kind::map) && map.items[i].find(key))
      return "did you mean '" + below(map.keys[i], key) + "'?";
  return "known here: " + alternatives(known);
}

}  // namespace

void refuse(const YamlNode& entry, const std::string& key, const std::string& what,
            const std::string& remedy) {
  throw input_error(entry.place.file, entry.place.line, (key.empty() ? "" : key + ": ") + what, remedy);
}

void expect(const YamlNode& entry, YamlNode::Kind kind, const std::string& key) {
  if (entry.is(kind)) return;
  const std::string found = entry.is(YamlNode::Kind::word) ? shown(entry) : name_of(entry.kind);
  refuse(entry, key, name_of(kind) + " is wanted here, not " + found, example_of(kind));
}

void check_keys(const YamlNode& map, const std::string& key, const std::vector<std::string>& known) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (std::find(known.begin(), known.end(), map.keys[i]) != known.end()) continue;
    const bool number = looks_like_quantity(map.keys[i]);  // {x: 0,1}
    throw input_error(map.key_places[i].file, map.key_places[i].line,
                      "unknown key '" + map.keys[i] + "'" + (key.empty() ? "" : " in " + key),
                      number ? "numbers have a decimal point: write 0.1, not 0,1"
                             : did_you_mean(map.keys[i], known, one_level_below(map, map.keys[i], known)));
  }
}

void refuse_former(const YamlNode& map, const std::string& key, const std::string& former,
                   const std::string& name) {
  if (map.find(former))
    refuse(*map.find(former), below(key, former), "the key has another name now",
           "write '" + name + "' (bulbus help scene --expert says what it means)");
}

void check_choice(const YamlNode& entry, const std::string& key, const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), entry.text) != choices.end()) return;
  const std::string guess = did_you_mean(entry.text, choices, "");
  refuse(entry, key, shown(entry) + " is not among the choices",
         guess + (guess.empty() ? "" : " ") + "choose " + alternatives(choices));
}

void check_name(const Place& place, const std::string& key, const std::string& name) {
  if (std::ranges::any_of(name, [](unsigned char c) { return std::iscntrl(c); }))
    throw input_error(
        place.file, place.line,
        key + ": the name '" + printable(name, true) + "' has a line break or another control character",
        "write it on one line, without \\n and the like");
}

void refuse_missing(const YamlNode& map, const std::string& key, const std::string& name,
                    const About& about) {
  refuse(map, key, "the key '" + name + "' is missing", "add '" + name + ": ...' (" + about.help + ")");
}

void read(const YamlNode& entry, const std::string& key, const About&, bool& value) {
  expect(entry, YamlNode::Kind::word, key);
  if (entry.text == "true" || entry.text == "yes" || entry.text == "on")
    value = true;
  else if (entry.text == "false" || entry.text == "no" || entry.text == "off")
    value = false;
  else
    refuse(entry, key, shown(entry) + " is neither true nor false", "write true or false");
}

void read(const YamlNode& entry, const std::string& key, const About& about, int& value) {
  expect(entry, YamlNode::Kind::word, key);
  const auto given = parse_number<int>(entry.text);
  if (!given) {
    const std::string bounds = bounds_text(about);
    refuse(entry, key, shown(entry) + " is not a whole number",
           "give a whole number" + (bounds.empty() ? "" : " " + bounds));
  }
  value = *given;
  check_bounds(entry, key, about, value);
}

void read(const YamlNode& entry, const std::string& key, const About& about, double& value) {
  expect(entry, YamlNode::Kind::word, key);
  try {
    value = parse_quantity(entry.text, about.quantity);
  } catch (const std::invalid_argument& fault) {
    refuse(entry, key, fault.what(), "give " + wanted_number(about));
  }
  if (about.quantity == Quantity::angle && std::abs(value) > std::min(most_radians, about.high) &&
      is_bare(entry.text))
    refuse(entry, key,
           shown(entry) +
               fmt::format(" would be {:.3g} turns: is it in degrees?", value / (2 * std::numbers::pi)),
           fmt::format("write the unit: '{0} deg' or '{0} rad'", entry.text));
  check_bounds(entry, key, about, value);
  if (std::abs(value) > largest || (value != 0 && std::abs(value) < least))
    refuse(entry, key, shown(entry) + " is beyond all measure",
           fmt::format("give 0, or a size between {} and {}", least, largest));
}

void read(const YamlNode& entry, const std::string& key, const About& about, std::string& value) {
  expect(entry, YamlNode::Kind::word, key);
  if (about.required && entry.text.empty()) refuse(entry, key, "is empty", "give " + about.help);
  if (!about.choices.empty()) check_choice(entry, key, about.choices);
  if (!about.formula && (key == "name" || key.ends_with(".name"))) check_name(entry.place, key, entry.text);
  value = about.formula ? read_formula(entry, key, about) : entry.text;
}

void read(const YamlNode& entry, const std::string& key, const About& about, Point& value) {
  expect(entry, YamlNode::Kind::list, key);
  if (entry.items.size() != value.size())
    refuse(entry, key, std::to_string(entry.items.size()) + " numbers where three are wanted",
           "write [x, y, z]");
  for (std::size_t i = 0; i < value.size(); ++i)
    read(entry.items[i], below(key, std::string(1, "xyz"[i])), about, value[i]);
}

}  // namespace bulbus::inline app::reader
