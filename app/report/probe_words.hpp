#pragma once
#include <string>

#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// What a probe measures, as a sentence without its end: "largest gap of the contact retina on detached".
std::string meaning_of(const ProbeSpec& probe);

/// "axial_change" as a title: "Axial change".
std::string title_of(const std::string& name);

}  // namespace bulbus::inline app
