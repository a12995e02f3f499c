#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/base/parameters.hpp"

namespace bulbus::inline app {

struct Member;
struct ValueType;

/// A value of a type that describe() may list (see About), as code sees it that is compiled once for all of
/// them: reader, writer and outline. It refers to a variable and does not own it. value_of() makes one.
class Value {
 public:
  enum class Kind { truth, integer, number, text, point, any, word, optional, list, map, group };
  Value(void* variable, const ValueType& type) : variable_(variable), type_(&type) {}
  Kind kind() const;

  /// The variable itself: bool of `truth`, int of `integer`, double of `number`, std::string of `text`, Point
  /// of `point`, YamlNode of `any`.
  template <class T>
  T& as() const {
    return *static_cast<T*>(variable_);
  }

  /// Of a `word`, which is an enumeration: all its words, its own, and another one of them.
  std::vector<std::string> words() const;
  std::string word() const;
  void choose(const std::string& word) const;

  /// Of an `optional`, `list` or `map`: the kind of what it holds.
  Kind inner_kind() const;
  void clear() const;
  /// Adds a default-made value: that of an optional, the last of a list, that at `key` of a map.
  Value add(const std::string& key = "") const;
  /// What it holds, in a map with their keys: of an optional at most one.
  std::vector<std::pair<std::string, Value>> items() const;

  /// Of a `group`, which is a described struct: its keys in their order.
  std::vector<Member> members() const;
  /// Throws InputError if the struct finds that its members contradict one another.
  void validate() const;
  /// The key behind which take_preset() sets defaults; null without one.
  const char* preset_key() const;
  void take_preset() const;

 private:
  void* variable_;
  const ValueType* type_;
};

/// A key of a described struct.
struct Member {
  std::string key;
  About about;
  Value value;
};

/// What Value does with variables of one type. Functions are null where the kind has no use for them.
struct ValueType {
  Value::Kind kind;
  std::vector<std::string> (*words)() = nullptr;
  std::string (*word)(void* variable) = nullptr;
  void (*choose)(void* variable, const std::string& word) = nullptr;
  const ValueType* inner = nullptr;
  void (*clear)(void* variable) = nullptr;
  void* (*add)(void* variable, const std::string& key) = nullptr;
  std::vector<std::pair<std::string, void*>> (*items)(void* variable) = nullptr;
  std::vector<Member> (*members)(void* variable) = nullptr;
  void (*validate)(void* variable) = nullptr;
  const char* preset_key = nullptr;
  void (*take_preset)(void* variable) = nullptr;
};

}  // namespace bulbus::inline app
