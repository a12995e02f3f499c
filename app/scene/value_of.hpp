#pragma once
#include "app/scene/concepts.hpp"
#include "app/scene/value.hpp"
#include "app/scene/yaml_node.hpp"

/// Makes Values. Slow to compile, since describe() of every struct below the variable is: parameters_of()
/// does it once for scenes and once for studies.
namespace bulbus::inline app {

template <class T>
const ValueType& value_type();

template <class T>
Value value_of(T& variable) {
  return {&variable, value_type<T>()};
}

namespace detail {

/// The visitor that lists the members of a described struct.
struct Lister {
  std::vector<Member>& members;
  template <class T>
  void operator()(const char* key, T& member, const About& about) const {
    members.push_back({key, about, value_of(member)});
  }
};

template <class T>
T& as(void* variable) {
  return *static_cast<T*>(variable);
}

template <class T>
Value::Kind leaf_kind() {
  using Kind = Value::Kind;
  if constexpr (std::same_as<T, bool>) return Kind::truth;
  if constexpr (std::same_as<T, int>) return Kind::integer;
  if constexpr (std::same_as<T, double>) return Kind::number;
  if constexpr (std::same_as<T, std::string>) return Kind::text;
  if constexpr (std::same_as<T, Point>) return Kind::point;
  if constexpr (std::same_as<T, YamlNode>) return Kind::any;
}

template <Worded E>
ValueType word_type() {
  return {.kind = Value::Kind::word,
          .words = [] { return all_words<E>(); },
          .word = [](void* variable) { return word_of(as<E>(variable)); },
          .choose = [](void* variable, const std::string& word) { as<E>(variable) = from_word<E>(word); }};
}

template <class T>
void* added(T& holder, [[maybe_unused]] const std::string& key) {
  if constexpr (concepts::Optional<T>) return &holder.emplace();
  if constexpr (concepts::List<T>) return &holder.emplace_back();
  if constexpr (concepts::Map<T>) return &holder[key];
}

template <class T>
std::vector<std::pair<std::string, void*>> items_of(T& holder) {
  std::vector<std::pair<std::string, void*>> items;
  if constexpr (concepts::Optional<T>) {
    if (holder) items.emplace_back("", &*holder);
  } else if constexpr (concepts::List<T>) {
    for (auto& item : holder) items.emplace_back("", &item);
  } else {
    for (auto& [key, item] : holder) items.emplace_back(key, &item);
  }
  return items;
}

/// `Inner`: what a T holds.
template <class T, class Inner>
ValueType holder_type(Value::Kind kind) {
  return {.kind = kind,
          .inner = &value_type<Inner>(),
          .clear = [](void* variable) { as<T>(variable) = T{}; },
          .add = [](void* variable, const std::string& key) { return added(as<T>(variable), key); },
          .items = [](void* variable) { return items_of(as<T>(variable)); }};
}

template <concepts::Described T>
ValueType group_type() {
  ValueType type{.kind = Value::Kind::group, .members = [](void* variable) {
                   std::vector<Member> members;
                   Lister lister{members};
                   as<T>(variable).describe(lister);
                   return members;
                 }};
  if constexpr (concepts::Checked<T>) type.validate = [](void* variable) { as<T>(variable).validate(); };
  if constexpr (concepts::Preset<T>) {
    type.preset_key = T::preset_key;
    type.take_preset = [](void* variable) { as<T>(variable).take_preset(); };
  }
  return type;
}

template <class T>
ValueType type_of() {
  if constexpr (concepts::Described<T>)
    return group_type<T>();
  else if constexpr (concepts::Optional<T>)
    return holder_type<T, typename T::value_type>(Value::Kind::optional);
  else if constexpr (concepts::List<T>)
    return holder_type<T, typename T::value_type>(Value::Kind::list);
  else if constexpr (concepts::Map<T>)
    return holder_type<T, typename T::mapped_type>(Value::Kind::map);
  else if constexpr (Worded<T>)
    return word_type<T>();
  else
    return {.kind = leaf_kind<T>()};
}

}  // namespace detail

template <class T>
const ValueType& value_type() {
  static const ValueType type = detail::type_of<T>();
  return type;
}

}  // namespace bulbus::inline app
