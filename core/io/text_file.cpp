#include "core/io/text_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace bulbus {

void rename_to(const std::string& temporary, const std::string& path) {
  if (std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const std::string reason = std::strerror(errno);
  std::remove(temporary.c_str());
  throw std::runtime_error(path + ": cannot be put in place: " + reason);
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
