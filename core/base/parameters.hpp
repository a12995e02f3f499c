#pragma once
#include <array>
#include <limits>
#include <string>
#include <string_view>
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
/// The scene reader, `help scene`, the schema, resolved.yaml and the docs follow from describe(). Members
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
  std::string former;                ///< the key's name in older scenes, which are told the new one
  Level level = Level::everyday;
  std::vector<Condition> conditions;  ///< the parameter acts where all of them hold

  About(std::string_view help, Quantity quantity = Quantity::number);
  About(const About&);  // these too are compiled once, not in each of the hundreds of places that make one
  About(About&&) noexcept;
  About& operator=(const About&);
  About& operator=(About&&) noexcept;
  ~About();

  About between(double a, double b) const;
  About at_least(double a) const;
  About positive() const;
  About needed() const;
  About expression() const;
  About one_of(std::vector<std::string> words) const;
  /// Of an optional number: what the program chooses while it is empty stands as 0 in scenes.
  About automatic() const;
  /// `key` was its name in older scenes.
  About formerly(std::string key) const;
  About expert() const;
  About debug() const;
  /// The parameter acts only where `key` is one of these: elsewhere a scene that gives it is refused.
  template <Worded E, std::same_as<E>... More>
  About only_with(std::string key, E first, More... more) const {
    return only_with_words(std::move(key), {word_of(first), word_of(more)...});
  }

 private:
  About only_with_words(std::string key, std::vector<std::string> words) const;
  About at(Level wanted) const;
};

}  // namespace bulbus
