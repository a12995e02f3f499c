#pragma once
#include <numbers>

namespace bulbus::inline eye {

/// In rad.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace bulbus::inline eye
