#pragma once
#include <string>
#include <utility>
#include <vector>

#include "core/base/parameters.hpp"

namespace bulbus {

/// "a, b or c".
std::string alternatives(const std::vector<std::string>& words);

/// Keys of the scene, and whether each is given.
using GivenKeys = std::vector<std::pair<std::string, bool>>;

/// Throws InputError unless exactly one of the keys is given: `owner` ("the mesh") has no `noun` ("source"),
/// or several.
void require_one(const std::string& owner, const std::string& noun, const GivenKeys& keys);

/// The members of a described struct that are std::optional.
template <class Described>
GivenKeys optional_members(Described described) {
  GivenKeys keys;
  described.describe([&](const char* key, auto& member, const About&) {
    if constexpr (requires { member.has_value(); }) keys.emplace_back(key, member.has_value());
  });
  return keys;
}

}  // namespace bulbus
