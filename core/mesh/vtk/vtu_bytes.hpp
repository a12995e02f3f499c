#pragma once
#include <string>
#include <string_view>

namespace bulbus::inline mesh {

/// Takes bytes from a base64 or raw stream in order.
class VtuBytes {
 public:
  VtuBytes(std::string_view stream, bool base64) : stream_(stream), base64_(base64) {}
  /// The next bytes; fewer where the stream ends or is no base64. Allocates no more than the stream holds.
  std::string take(std::size_t count);

 private:
  bool decode_four();

  std::string_view stream_;
  bool base64_;
  std::string decoded_;  ///< and not yet taken
};

/// How the binary arrays of a file are kept.
struct VtuFormat {
  bool swapped = false;     ///< bytes are of the other order
  bool wide = false;        ///< sizes are of eight bytes, not four
  bool compressed = false;  ///< by zlib, in blocks
};

/// The bytes of one array behind its sizes. Throws std::length_error with what is wrong.
std::string array_bytes(VtuBytes bytes, const VtuFormat& format);

}  // namespace bulbus::inline mesh
