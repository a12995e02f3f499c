#pragma once
#include <memory>
#include <string>

#include "core/base/tensor.hpp"

namespace bulbus {

/// A number, or an expression in the reference place X, Y, Z (mm), the part s of the step done and the time t.
class Formula {
 public:
  /// `where` names the key in error messages. Throws InputError if the text cannot be read.
  Formula(const std::string& text, const std::string& where);
  ~Formula();
  Formula(Formula&&) noexcept;

  /// True for a plain number, which steps approach linearly.
  bool constant() const { return constant_; }
  double operator()(const Vec3<double>& X, double s, double t) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  bool constant_ = false;
  double value_ = 0;
};

}  // namespace bulbus
