#include "core/problem/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cfenv>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/base/characters.hpp"
#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace bulbus::inline problem {
namespace {

// A comparison with what is not a number is false, max and min may pass over it, and 1/(1/0) is 0, whatever
// is meant: only the processor's flags tell of it. Overflow is left, as 1/(1 + exp(1000)) is 0 rightly.
constexpr int no_value = FE_INVALID | FE_DIVBYZERO;

constexpr const char* decimal_point = "Numbers have a decimal point: write 0.1, not 0,1.";

// A comma that separates no arguments of a function: `0,1`, `2*(0,5)`.
bool has_stray_comma(const std::string& text) {
  std::vector<bool> in_call{false};
  char before = ' ';
  for (char c : text) {
    if (c == ',' && !in_call.back()) return true;
    if (c == '(') in_call.push_back(is_word(before));
    if (c == ')' && in_call.size() > 1) in_call.pop_back();
    if (c != ' ') before = c;
  }
  return false;
}

// `0.1 < X < 0.9` is (0.1 < X) < 0.9, which compares 0 or 1 with 0.9: two comparisons with nothing between
// them that joins or parts conditions. A call or a parenthesis is a place of its own.
bool compares_twice(const std::string& text) {
  std::vector<int> comparisons{0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
    if (c == '(') comparisons.push_back(0);
    if (c == ')' && comparisons.size() > 1) comparisons.pop_back();
    if (c == '&' || c == '|' || c == '?' || c == ':' || c == ',') comparisons.back() = 0;
    const bool two = next == '=' && (c == '=' || c == '!' || c == '<' || c == '>');
    if (!two && c != '<' && c != '>') continue;
    if (++comparisons.back() > 1) return true;
    i += two;
  }
  return false;
}

// `X = 1` would set X, and be 1 everywhere.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool twice = i + 1 < text.size() && text[i + 1] == '=';
    if (!twice && (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos))
      return true;
    i += twice;
  }
  return false;
}

}  // namespace

struct Formula::Parser {
  mu::Parser expression;
  double X = 0, Y = 0, Z = 0, s = 0, t = 0;
};

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

Formula::Formula(const std::string& text, const std::string& where) : text_(text), where_(where) {
  char* end = nullptr;
  value_ = std::strtod(text.c_str(), &end);
  const std::string rest = end;
  bare_ = rest.empty();
  constant_ = end != text.c_str() && std::isfinite(value_) &&
              (bare_ || rest == fmt::format(" {}", unit_of(Quantity::length)) ||
               rest == fmt::format(" {}", unit_of(Quantity::stress)));
  if (constant_) return;
  bare_ = false;
  if (has_stray_comma(text))
    throw scene_error(where, fmt::format("the formula '{}' has a comma outside of a function", text),
                      decimal_point);
  if (assigns(text))
    throw scene_error(where, fmt::format("the formula '{}' has a single '=', which compares nothing", text),
                      "Write == to compare, or of coordinates better \"abs(X - 1) < 0.001\".");
  if (compares_twice(text))
    throw scene_error(
        where, fmt::format("the formula '{}' compares the outcome of a comparison, which is 0 or 1", text),
        "Join two comparisons by &&, such as \"0.1 < X && X < 0.9\".");
  parser_ = std::make_unique<Parser>();
  auto& p = *parser_;
  try {
    for (auto [name, variable] : {std::pair{"X", &p.X}, {"Y", &p.Y}, {"Z", &p.Z}, {"s", &p.s}, {"t", &p.t}})
      p.expression.DefineVar(name, variable);
    p.expression.DefineConst("pi", 3.14159265358979323846);
    p.expression.SetExpr(text);
    std::feclearexcept(no_value);
    const double first = p.expression.Eval();  // computes the parts without variables
    const bool then = std::fetestexcept(no_value);
    std::feclearexcept(no_value);
    p.expression.Eval();
    if (std::isfinite(first) && then && !std::fetestexcept(no_value))
      throw scene_error(
          where, fmt::format("a part of the formula '{}' has no finite value", text),
          "Parts such as sqrt(-1) or 1/0 are hidden by comparisons, min and max: write what is meant.");
  } catch (const mu::ParserError& e) {
    throw scene_error(
        where, fmt::format("cannot read the formula '{}': {}", text, e.GetMsg()),
        std::string("Give a number, or an expression in X, Y, Z, s (0 to 1 over the step) and t.") +
            (text.find(',') == std::string::npos ? "" : std::string(" ") + decimal_point));
  }
}

double Formula::operator()(const Vec3<double>& X, double s, double t) const {
  if (constant_) return value_;
  auto& p = *parser_;
  p.X = X[0], p.Y = X[1], p.Z = X[2], p.s = s, p.t = t;
  std::feclearexcept(no_value);
  const double value = p.expression.Eval();
  if (std::isfinite(value) && std::fetestexcept(no_value))
    throw scene_error(
        where_,
        fmt::format("a part of '{}' is {} at X = {:.6g}, Y = {:.6g}, Z = {:.6g}, s = {:.4g}, t = {:.4g}",
                    text_, std::fetestexcept(FE_INVALID) ? "not a number" : "infinite", X[0], X[1], X[2], s,
                    t),
        "Every part must have a value there, or be left out where it has none: \"X > 1 ? sqrt(X - 1) : 0\".");
  if (!std::isfinite(value))
    throw scene_error(
        where_,
        fmt::format("the formula '{}' is not a finite number at X = {:.6g}, Y = {:.6g}, Z = {:.6g}, s = "
                    "{:.4g}, t = {:.4g}: it is {}",
                    text_, X[0], X[1], X[2], s, t, std::isnan(value) ? "not a number" : "infinite"),
        "It must have a value everywhere on its set, from s = 0 to s = 1.");
  return value;
}

void Formula::require_finite(const Vec3<double>& X, int step) const {
  if (constant_) return;
  (*this)(X, 0, step);
  for (double s : looked_at) (*this)(X, s, step + s);
}

void Formula::require_uniform() const {
  if (constant_) return;
  for (const auto& [name, variable] : parser_->expression.GetUsedVar())
    if (name == "X" || name == "Y" || name == "Z")
      throw scene_error(where_,
                        "the formula '" + text_ + "' depends on " + name +
                            ", but a pressure is the same on the whole surface",
                        "Give a number, or an expression in s (0 to 1 over the step) and t; cut the surface "
                        "into several for a pressure that varies.");
}

bool Formula::holds(const Vec3<double>& X) const {
  const double value = (*this)(X, 0, 0);
  if (value != 0 && value != 1)
    throw scene_error(where_,
                      fmt::format("'{}' is no condition: at X = {:.6g}, Y = {:.6g}, Z = {:.6g} it is {:.6g}",
                                  text_, X[0], X[1], X[2], value),
                      "Compare, as in \"X < 0.1\" or \"X*X + Y*Y < 1.01 && Z > 0\".");
  return value == 1;
}

void Formula::require_timeless() const {
  if (constant_) return;
  for (const auto& [name, variable] : parser_->expression.GetUsedVar())
    if (name == "s" || name == "t")
      throw scene_error(where_,
                        "the formula '" + text_ + "' depends on " + name + ", but a mesh has no steps",
                        "Give it in X, Y and Z alone.");
}

}  // namespace bulbus::inline problem
