#pragma once
#include <limits>
#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "core/base/words.hpp"

namespace bulbus {

/// Who sets a parameter: `help scene` shows the first of these, and the others on request.
enum class Level { everyday, expert, debug };
constexpr std::array<std::string_view, 3> words(Level) { return {"everyday", "expert", "debug"}; }

/// What another key has to be for a parameter to act.
struct Condition {
  std::string key;                 ///< its path from the root: solver.linear.method
  std::vector<std::string> words;  ///< one of these
};

/// What is said of a parameter beside its default: one line of help, unit, bounds, allowed words, level, and
/// with which choices it acts.
///
/// A settings struct lists its members once, each beside its default:
///
///     struct KrylovSettings {
///       int restart = 30;
///       template <class V> void describe(V&& v) {
///         v("restart", restart, About{"basis vectors before a restart"}.between(2, 500));
///       }
///     };
///
/// The scene reader, `help scene`, the schema, resolved.yaml and the docs are visitors of describe(). Members
/// may be bool, int, double, std::string, an enumeration with words, Point, std::vector of these, another
/// such struct, std::optional of any of them, and std::vector or std::map<std::string, ...> of any of them. A
/// string with About::formula holds a number with its unit or an expression. Level and conditions of a struct
/// are those of its members too.
struct About {
  std::string help;
  Quantity quantity = Quantity::number;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;  ///< low itself is not allowed
  bool required = false;
  bool formula = false;  ///< a string that holds a number with a unit, or an expression in X, Y, Z, t, s
  bool zero_is_automatic = false;    ///< of an optional number: 0 is written where it is empty
  std::vector<std::string> choices;  ///< the words a string may be
  Level level = Level::everyday;
  std::vector<Condition> conditions;  ///< the parameter acts where all of them hold

  About(std::string help, Quantity quantity = Quantity::number) : help(std::move(help)), quantity(quantity) {}
  About between(double a, double b) const {
    About r = *this;
    r.low = a, r.high = b;
    return r;
  }
  About at_least(double a) const { return between(a, high); }
  About positive() const {
    About r = between(0, high);
    r.above = true;
    return r;
  }
  About needed() const {
    About r = *this;
    r.required = true;
    return r;
  }
  About expression() const {
    About r = *this;
    r.formula = true;
    return r;
  }
  About one_of(std::vector<std::string> words) const {
    About r = *this;
    r.choices = std::move(words);
    return r;
  }
  /// Of an optional number: what the program chooses while it is empty stands as 0 in scenes.
  About automatic() const {
    About r = *this;
    r.zero_is_automatic = true;
    return r;
  }
  About expert() const { return at(Level::expert); }
  About debug() const { return at(Level::debug); }
  /// The parameter acts only where `key` is one of these: elsewhere a scene that gives it is refused.
  template <Worded E, std::same_as<E>... More>
  About only_with(std::string key, E first, More... more) const {
    About r = *this;
    r.conditions.push_back({std::move(key), {word_of(first), word_of(more)...}});
    return r;
  }

 private:
  About at(Level wanted) const {
    About r = *this;
    r.level = wanted;
    return r;
  }
};

}  // namespace bulbus
