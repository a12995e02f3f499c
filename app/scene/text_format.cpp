#include "app/scene/text_format.hpp"

#include <fmt/format.h>

#include <cmath>

namespace bulbus::inline app {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  const auto e = text.find('e');
  if (e != std::string::npos && text.find('.') == std::string::npos) text.insert(e, ".0");
  return text;
}

std::string bounds_text(const About& about) {
  const bool low = std::isfinite(about.low), high = std::isfinite(about.high);
  const std::string least = (about.above ? "above " : "at least ") + fmt::format("{}", about.low);
  const std::string most = fmt::format("{}", about.high);
  if (low && high && !about.above) return fmt::format("between {} and {}", about.low, most);
  if (low && high) return least + " and at most " + most;
  if (low) return least;
  return high ? "at most " + most : "";
}

std::string conditions_text(std::span<const Condition> conditions) {
  std::string text;
  for (const Condition& c : conditions)
    text += (text.empty() ? "; only with " : " and ") + c.key.substr(c.key.rfind('.') + 1) + ": " +
            alternatives(c.words);
  return text;
}

std::string wanted_number(const About& about) {
  const std::string unit = unit_of(about.quantity), bounds = bounds_text(about);
  return (unit.empty() ? std::string("a number") : "a number in " + unit + ", or with its unit") +
         (bounds.empty() ? "" : ", " + bounds);
}

}  // namespace bulbus::inline app
