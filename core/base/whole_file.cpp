#include "core/base/whole_file.hpp"

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/memory.hpp"

namespace bulbus {

std::string whole_file(const std::string& path, const std::string& what) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  std::ifstream file(path, std::ios::binary);
  if (!file || failure || !std::filesystem::is_regular_file(path, failure))
    throw input_error(path, 0, "cannot read the " + what,
                      "Check the path; it is relative to the scene file.");
  if (size > machine_bytes() / 4)
    throw input_error(
        path, 0,
        "the " + what + " has " + std::to_string(size / 1000000) + " MB: too much for this machine's memory",
        "Check the path, mesh more coarsely, or take a machine with more memory.");
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

}  // namespace bulbus
