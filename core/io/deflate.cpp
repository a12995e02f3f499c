#include "core/io/deflate.hpp"

#include <zlib.h>

#include <stdexcept>

namespace bulbus::inline io {

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> packed(size);
  const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (status != Z_OK) throw std::runtime_error("zlib cannot compress an array");
  packed.resize(size);
  return packed;
}

}  // namespace bulbus::inline io
