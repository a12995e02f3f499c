#pragma once
#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/parameters.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline app::concepts {

/// A visitor that looks at nothing: it only serves to ask whether a type describes itself.
struct Blind {
  template <class T>
  void operator()(const char*, T&, const About&) const {}
};

template <class T>
concept Described = requires(T& t, Blind v) {
  t.describe(v);
};

/// A described struct may check what one key alone cannot tell: throws InputError without a place.
template <class T>
concept Checked = requires(const T& t) {
  t.validate();
};

/// A described struct whose key `preset_key` chooses the defaults of keys behind it.
template <class T>
concept Preset = requires(T& t) {
  T::preset_key;
  t.take_preset();
};

template <class T>
struct is_optional : std::false_type {};
template <class T>
struct is_optional<std::optional<T>> : std::true_type {};
template <class T>
concept Optional = is_optional<T>::value;

template <class T>
struct is_list : std::false_type {};
template <class T>
struct is_list<std::vector<T>> : std::true_type {};
template <class T>
concept List = is_list<T>::value;

template <class T>
struct is_map : std::false_type {};
template <class T>
struct is_map<std::map<std::string, T>> : std::true_type {};
template <class T>
concept Map = is_map<T>::value;

}  // namespace bulbus::inline app::concepts
