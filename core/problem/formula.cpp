#include "core/problem/formula.hpp"

#include <muParser.h>

#include <cmath>

#include "core/base/error.hpp"

namespace bulbus {

struct Formula::Parser {
  mu::Parser expression;
  double X = 0, Y = 0, Z = 0, s = 0, t = 0;
};

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

Formula::Formula(const std::string& text, const std::string& where) {
  char* end = nullptr;
  value_ = std::strtod(text.c_str(), &end);
  constant_ = end != text.c_str() && *end == '\0' && std::isfinite(value_);
  if (constant_) return;
  parser_ = std::make_unique<Parser>();
  auto& p = *parser_;
  try {
    for (auto [name, variable] : {std::pair{"X", &p.X}, {"Y", &p.Y}, {"Z", &p.Z}, {"s", &p.s}, {"t", &p.t}})
      p.expression.DefineVar(name, variable);
    p.expression.DefineConst("pi", 3.14159265358979323846);
    p.expression.SetExpr(text);
    p.expression.Eval();
  } catch (const mu::ParserError& e) {
    throw scene_error(where, "cannot read the formula '" + text + "': " + e.GetMsg(),
                      "Give a number, or an expression in X, Y, Z, s (0 to 1 over the step) and t.");
  }
}

double Formula::operator()(const Vec3<double>& X, double s, double t) const {
  if (constant_) return value_;
  auto& p = *parser_;
  p.X = X[0], p.Y = X[1], p.Z = X[2], p.s = s, p.t = t;
  return p.expression.Eval();
}

}  // namespace bulbus
