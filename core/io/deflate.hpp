#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace bulbus::inline io {

/// The bytes as a zlib stream (RFC 1950), which browsers inflate under the name "deflate".
std::vector<std::byte> deflated(std::span<const std::byte> bytes);

}  // namespace bulbus::inline io
