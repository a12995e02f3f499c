#include "core/io/output.hpp"

#include <cerrno>
#include <cstring>

#include "core/base/error.hpp"

namespace bulbus::inline io {
namespace {

std::string reason_of(int error) {
  switch (error) {
    case ENOSPC:
      return "no space left on the disk";
    case EDQUOT:
      return "no space left in the disk quota";
    case EFBIG:
      return "no space left: a file may not grow that large (ulimit -f)";
    default:
      return std::strerror(error);
  }
}

}  // namespace

void write_together(const Comm& comm, const std::function<void()>& work) {
  try {
    comm.together([&] {
      try {
        work();
      } catch (const std::runtime_error& e) {
        throw InputError(e.what());
      }
    });
  } catch (const InputError& e) {
    throw OutputError(e.what());
  }
}

std::string not_written(std::string path, int error) {
  if (path.ends_with(".tmp")) path.resize(path.size() - 4);
  return path + ": cannot be written: " + reason_of(error);
}

}  // namespace bulbus::inline io
