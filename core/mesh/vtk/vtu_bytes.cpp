#include "core/mesh/vtk/vtu_bytes.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "core/mesh/vtk/vtk_grid.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr double most_deflated = 1032;  // zlib makes nothing smaller by more

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

[[noreturn]] void fail(const std::string& what) { throw std::length_error(what); }

double next_size(VtuBytes& bytes, const VtuFormat& format) {
  const VtkType type = format.wide ? VtkType::u64 : VtkType::u32;
  const std::string raw = bytes.take(size_of(type));
  if (raw.size() < static_cast<std::size_t>(size_of(type))) fail("the data end too early");
  return numbers_in(raw, type, format.swapped)[0];
}

std::string exactly(VtuBytes& bytes, double size) {
  std::string taken = size < 1e15 ? bytes.take(static_cast<std::size_t>(size)) : "";
  if (static_cast<double>(taken.size()) != size)
    fail(fmt::format("the data end too early: {:.0f} bytes are announced", size));
  return taken;
}

void unpack(const std::string& packed, double size, std::string& all) {
  if (size > 64 + most_deflated * static_cast<double>(packed.size()))
    fail(fmt::format("a block of {} bytes cannot hold the {:.0f} that are announced", packed.size(), size));
  const std::size_t before = all.size();
  all.resize(before + static_cast<std::size_t>(size));
  uLongf written = static_cast<uLongf>(size);
  const int status = uncompress(reinterpret_cast<Bytef*>(all.data() + before), &written,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (status != Z_OK || written != static_cast<uLongf>(size)) fail("a block is no whole zlib stream");
}

}  // namespace

// Three bytes, or fewer where "=" pads them: sizes may be padded apart from what follows.
bool VtuBytes::decode_four() {
  std::array<int, 4> v{};
  int count = 0, padding = 0;
  for (; count < 4 && !stream_.empty(); stream_.remove_prefix(1)) {
    const char c = stream_.front();
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    if (c == '=') ++padding;
    v[count] = c == '=' ? 0 : value_of(c);
    if (v[count++] < 0 || (padding > 0 && c != '=')) return false;
  }
  if (count < 4 || padding > 2) return false;
  const int all = v[0] << 18 | v[1] << 12 | v[2] << 6 | v[3];
  for (int i = 0; i < 3 - padding; ++i) decoded_ += static_cast<char>(all >> (16 - 8 * i) & 255);
  return true;
}

std::string VtuBytes::take(std::size_t count) {
  if (!base64_) {
    const std::string taken(stream_.substr(0, count));
    stream_.remove_prefix(taken.size());
    return taken;
  }
  while (decoded_.size() < count && decode_four()) {
  }
  std::string rest = decoded_.substr(std::min(count, decoded_.size()));
  decoded_.resize(std::min(count, decoded_.size()));
  std::swap(rest, decoded_);
  return rest;
}

std::string array_bytes(VtuBytes bytes, const VtuFormat& format) {
  const double first = next_size(bytes, format);
  if (!format.compressed) return exactly(bytes, first);
  const double block = next_size(bytes, format), last = next_size(bytes, format);
  std::vector<double> packed;  // grows by what the stream holds
  for (double b = 0; b < first; ++b) packed.push_back(next_size(bytes, format));
  std::string all;
  for (std::size_t b = 0; b < packed.size(); ++b) {
    const bool partial = b + 1 == packed.size() && last > 0;
    unpack(exactly(bytes, packed[b]), partial ? last : block, all);
  }
  return all;
}

}  // namespace bulbus::inline mesh
