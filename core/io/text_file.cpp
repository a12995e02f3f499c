#include "core/io/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/io/disk_file.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline io {
namespace {

// Of a file or a folder.
void flush_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed =
      file >= 0 && (fsync(file) == 0 || errno == EINVAL);  // some file systems have no fsync of folders
  const int error = errno;
  if (file >= 0) close(file);
  if (!flushed) throw std::runtime_error(not_written(path, error));
}

void rename_to(const std::string& temporary, const std::string& path) {
  if (std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int error = errno;
  std::remove(temporary.c_str());
  throw std::runtime_error(not_written(path, error));
}

}  // namespace

std::string content_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void settle(const std::string& temporary, const std::string& path) {
  flush_to_disk(temporary);
  rename_to(temporary, path);
  const auto folder = std::filesystem::path(path).parent_path();
  flush_to_disk(folder.empty() ? "." : folder.string());
}

void write_whole(const std::string& path, const std::function<void(const std::string&)>& write) {
  const std::string temporary = path + ".tmp";
  try {
    write(temporary);
    flush_to_disk(temporary);
  } catch (const std::runtime_error&) {
    std::remove(temporary.c_str());
    throw;
  }
  rename_to(temporary, path);
}

void write_whole(const std::string& path, const std::string& text) {
  write_whole(path,
              [&](const std::string& temporary) { DiskFile(temporary, DiskFile::Start::empty).write(text); });
}

}  // namespace bulbus::inline io
