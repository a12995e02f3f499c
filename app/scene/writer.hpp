#pragma once
#include "app/scene/entry.hpp"
#include "app/scene/value.hpp"

namespace bulbus {

/// Any value as an Entry, defaults and all, with its unit as a note; what is optional and empty is left out.
Entry entry_of(const Value& value, const About& about = About{""});

}  // namespace bulbus
