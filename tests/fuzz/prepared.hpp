#pragma once
#include "app/prepare.hpp"
#include "app/scene/yaml_node.hpp"

namespace bulbus::fuzz {

/// Thrown where a mutant is accepted though it should not be.
struct Silent : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What `bulbus check` does with a scene, on one rank. Throws InputError with its place, or Silent where a
/// number of the prepared problem is not finite.
Prepared prepare_checked(const YamlNode& root, const std::string& path);

}  // namespace bulbus::fuzz
