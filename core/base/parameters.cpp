#include "core/base/parameters.hpp"

#include <utility>

namespace bulbus {

About::About(std::string_view help, Quantity quantity) : help(help), quantity(quantity) {}
About::About(const About&) = default;
About::About(About&&) noexcept = default;
About& About::operator=(const About&) = default;
About& About::operator=(About&&) noexcept = default;
About::~About() = default;

About About::between(double a, double b) const {
  About r = *this;
  r.low = a, r.high = b;
  return r;
}

About About::at_least(double a) const { return between(a, high); }

About About::positive() const {
  About r = between(0, high);
  r.above = true;
  return r;
}

About About::needed() const {
  About r = *this;
  r.required = true;
  return r;
}

About About::expression() const {
  About r = *this;
  r.formula = true;
  return r;
}

About About::one_of(std::vector<std::string> words) const {
  About r = *this;
  r.choices = std::move(words);
  return r;
}

About About::automatic() const {
  About r = *this;
  r.zero_is_automatic = true;
  return r;
}

About About::formerly(std::string key) const {
  About r = *this;
  r.former = std::move(key);
  return r;
}

About About::expert() const { return at(Level::expert); }
About About::debug() const { return at(Level::debug); }

About About::only_with_words(std::string key, std::vector<std::string> words) const {
  About r = *this;
  r.conditions.push_back({std::move(key), std::move(words)});
  return r;
}

About About::at(Level wanted) const {
  About r = *this;
  r.level = wanted;
  return r;
}

}  // namespace bulbus
