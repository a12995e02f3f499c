#include "core/io/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace bulbus {
namespace {

// Of a file or a folder.
void flush_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY);
  const bool flushed = file >= 0 && fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (!flushed) throw std::runtime_error(path + ": cannot be brought to the disk: " + reason);
}

}  // namespace

void rename_to(const std::string& temporary, const std::string& path) {
  if (std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(temporary.c_str());
  throw std::runtime_error(path + ": cannot be put in place: " + reason);
}

void settle(const std::string& temporary, const std::string& path) {
  flush_to_disk(temporary);
  rename_to(temporary, path);
  const auto folder = std::filesystem::path(path).parent_path();
  flush_to_disk(folder.empty() ? "." : folder.string());
}

void write_whole(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".tmp";
  std::ofstream out(temporary, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    std::remove(temporary.c_str());
    throw std::runtime_error(path + ": cannot be written (no such folder, no permission, or a full disk?)");
  }
  rename_to(temporary, path);
}

}  // namespace bulbus
