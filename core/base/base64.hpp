#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace bulbus {

/// Base64 of the bytes (RFC 4648), padded.
std::string base64(std::span<const std::byte> bytes);

}  // namespace bulbus
