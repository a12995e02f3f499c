#pragma once
#include <numbers>

namespace bulbus {

/// In rad.
inline constexpr double degree = std::numbers::pi / 180;

}  // namespace bulbus
