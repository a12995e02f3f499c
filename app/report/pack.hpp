#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bulbus::inline app {

/// Values as the page gets them: whole numbers from 0 to `quantum_top` between two bounds, `no_value` for
/// NaN.
constexpr std::uint16_t quantum_top = 65534, no_value = 65535;
std::vector<std::uint16_t> quantised(std::span<const float> values, float low, float high);

/// Differences to `before` (empty: to 0), their low bytes, then their high ones, deflated, as base64:
/// `unpacked16` of page/data.js is the other way.
std::string packed(std::span<const std::uint16_t> values, std::span<const std::uint16_t> before = {});

/// The same with differences to the number `stride` places before, in four planes of bytes: `unpacked32`.
std::string packed(std::span<const std::uint32_t> values, std::size_t stride);

}  // namespace bulbus::inline app
