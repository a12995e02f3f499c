#pragma once
#include <array>
#include <memory>
#include <string>

#include "core/base/tensor.hpp"

namespace bulbus::inline problem {

/// Parts of a step at which what it prescribes is looked at before it begins: no period hides from all.
inline constexpr std::array looked_at{1., .5, .17, .39, .71};

/// A number, with or without the unit it is kept in, or an expression in the reference position X, Y, Z (mm),
/// the part s of the step done and the time t. Comparisons (<, <=, >, >=, ==, !=, &&, ||) are 1 where they
/// hold, else 0.
class Formula {
 public:
  /// `where` names the key in error messages. Throws InputError if the text cannot be read or has a decimal
  /// comma.
  Formula(const std::string& text, const std::string& where);
  ~Formula();
  Formula(Formula&&) noexcept;

  /// True for a plain number, which steps approach linearly.
  bool constant() const { return constant_; }
  /// True for a plain number whose unit the scene leaves out.
  bool bare() const { return bare_; }
  /// Throws InputError that tells formula, place and s where the value is not a finite number.
  double operator()(const Vec3<double>& X, double s, double t) const;
  /// Refuses a formula that is not finite at the begin, middle or end of step number `step`.
  void require_finite(const Vec3<double>& X, int step) const;
  /// Refuses a formula in X, Y or Z where one value holds for all places.
  void require_uniform() const;
  /// Whether a condition such as `X < 0.1` holds at a place. Throws InputError where its value is neither 0
  /// nor 1, or a part of it is not a number.
  bool holds(const Vec3<double>& X) const;
  /// Refuses a formula in s or t where there are no steps.
  void require_timeless() const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string text_, where_;
  bool constant_ = false, bare_ = false;
  double value_ = 0;
};

}  // namespace bulbus::inline problem
