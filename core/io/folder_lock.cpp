#include "core/io/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"

namespace bulbus::inline io {

FolderLock::FolderLock(const std::string& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0)
    throw input_error(folder + ": cannot be opened as a folder of results: " + std::strerror(errno),
                      "Name another with -o.");
  held_ = flock(folder_, LOCK_EX | LOCK_NB) == 0;
  if (held_ || errno != EWOULDBLOCK) return;
  close(folder_);
  throw input_error(folder + ": another run is writing into this folder",
                    "Wait for its end, end it, or name another folder with -o.");
}

FolderLock::~FolderLock() { close(folder_); }

}  // namespace bulbus::inline io
