#pragma once
#include "app/scene/value.hpp"
#include "app/scene/yaml_node.hpp"

namespace bulbus::inline app {

/// Any value as a YamlNode, defaults and all, with its unit as a note; what is optional and empty is left
/// out.
YamlNode entry_of(const Value& value, const About& about = About{""});

}  // namespace bulbus::inline app
