#pragma once
#include <algorithm>

#include "app/scene/writer.hpp"

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

template <class T>
Topic outline_of(const std::string& key, const About& about, T& value);

/// The outline of a value whose defaults are those of a default-made T.
template <class T>
Topic outline_of(const std::string& key, const About& about) {
  T made{};
  return outline_of(key, about, made);
}

template <kinds::Described T>
std::vector<Topic> parts_of(T& object) {
  std::vector<Topic> parts;
  object.describe([&](const char* key, auto& member, const About& about) {
    parts.push_back(outline_of(key, about, member));
    parts.back().fallback = writer::entry_of(member, about);
  });
  return parts;
}

/// Gives all that is below a topic the topic's level and conditions.
inline void inherit(Topic& topic, const About& about) {
  for (Topic& part : topic.parts) {
    part.about.level = std::max(part.about.level, about.level);
    part.about.conditions.insert(part.about.conditions.begin(), about.conditions.begin(),
                                 about.conditions.end());
    inherit(part, about);
  }
}

/// The outline of `value`, which holds the defaults.
template <class T>
Topic outline_of(const std::string& key, const About& about, T& value) {
  using Kind = Topic::Kind;
  Topic topic;
  if constexpr (kinds::Optional<T>) {
    topic = outline_of<typename T::value_type>(key, about);
    topic.optional = !about.zero_is_automatic;
    return topic;
  } else if constexpr (kinds::Described<T>) {
    topic.kind = Kind::group;
    topic.parts = parts_of(value);
  } else if constexpr (kinds::List<T>) {
    topic.kind = Kind::list;
    topic.parts = {outline_of<typename T::value_type>("", about)};
  } else if constexpr (kinds::Map<T>) {
    topic.kind = Kind::map;
    topic.parts = {outline_of<typename T::mapped_type>("", about)};
  } else {
    topic.kind = std::same_as<T, bool>     ? Kind::truth
                 : std::same_as<T, int>    ? Kind::integer
                 : std::same_as<T, double> ? Kind::number
                 : std::same_as<T, Point>  ? Kind::point
                 : std::same_as<T, Entry>  ? Kind::any
                                           : Kind::text;
  }
  topic.key = key;
  topic.about = about;
  if constexpr (Worded<T>) topic.about.choices = all_words<T>();
  if constexpr (kinds::Described<T>) inherit(topic, about);
  return topic;
}

}  // namespace bulbus
