#pragma once
#include <limits>
#include <string>
#include <vector>

#include "core/base/units.hpp"

namespace bulbus {

/// What is said of a parameter beside its default: one line of help, unit, bounds, allowed words.
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
/// may be bool, int, double, std::string, Point, std::vector of these, another such struct, std::optional of
/// any of them, and std::vector or std::map<std::string, ...> of any of them. A string with About::formula
/// holds a number with its unit or an expression.
struct About {
  std::string help;
  Quantity quantity = Quantity::number;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;  ///< low itself is not allowed
  bool required = false;
  bool formula = false;  ///< a string that holds a number with a unit, or an expression in X, Y, Z, t, s
  std::vector<std::string> choices;  ///< the words a string may be

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
};

}  // namespace bulbus
