#pragma once
#include <string>
#include <vector>

#include "app/scene/entry.hpp"
#include "app/scene/value.hpp"

namespace bulbus {

/// What may be written at one place of a scene: the common source of the help and of the schema.
struct Topic {
  enum class Kind { truth, integer, number, text, point, group, list, map, any };
  std::string key;
  About about{""};
  Kind kind = Kind::text;
  bool optional = false;     ///< may be left out without a default taking its place
  Entry fallback;            ///< the default
  std::vector<Topic> parts;  ///< the keys of a group; the one entry of a list or map
};

/// The outline of `value`, which holds the defaults; what is optional in it, and its lists and maps, are
/// overwritten.
Topic outline_of(const std::string& key, const About& about, const Value& value);

}  // namespace bulbus
