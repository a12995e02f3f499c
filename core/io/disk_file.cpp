#include "core/io/disk_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

#include "core/io/output.hpp"

namespace bulbus::inline io {

DiskFile::DiskFile(std::string path, Start start)
    : path_(std::move(path)),
      file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (start == Start::empty ? O_TRUNC : O_APPEND),
                 0666)) {
  if (file_ < 0) fail(errno);
}

DiskFile::~DiskFile() { close(file_); }

void DiskFile::write(std::string_view text) {
  const off_t before = lseek(file_, 0, SEEK_END);
  while (!text.empty()) {
    const ssize_t written = ::write(file_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      [[maybe_unused]] const int cut = before >= 0 ? ftruncate(file_, before) : 0;
      fail(error);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void DiskFile::reserve(long long bytes) {
#ifdef FALLOC_FL_KEEP_SIZE
  int error = 0;
  do error = fallocate(file_, 0, 0, bytes) == 0 ? 0 : errno;
  while (error == EINTR);
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) fail(error);
#endif
}

void DiskFile::fail(int error) const { throw std::runtime_error(not_written(path_, error)); }

}  // namespace bulbus::inline io
