#include "core/base/require_one.hpp"

#include "core/base/error.hpp"

namespace bulbus {

std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

void require_one(const std::string& owner, const std::string& noun, const GivenKeys& keys) {
  std::vector<std::string> all;
  std::string given;
  int count = 0;
  for (const auto& [key, is_given] : keys) {
    all.push_back(key);
    if (is_given) given += (count++ ? " and " : "") + key;
  }
  if (count == 0) throw input_error(owner + " has no " + noun, "give one of " + alternatives(all));
  if (count > 1)
    throw input_error(owner + " has " + std::to_string(count) + " " + noun + "s: " + given,
                      "keep exactly one of " + alternatives(all));
}

}  // namespace bulbus
