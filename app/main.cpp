#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>

#include "app/command_line.hpp"
#include "core/io/output.hpp"

namespace {

// Without what MPI and HDF5 would do with files that cannot be written.
[[noreturn]] void leave(int status, const bulbus::Comm& comm) {
  std::cout.flush();
  if (comm.size() > 1) MPI_Abort(comm.raw(), status);
  _exit(status);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told as a full disk is
  const bulbus::Session session(argc, argv);
  const bulbus::Comm comm;
  try {
    const int status = bulbus::command_line({argv + 1, argv + argc}, comm, std::cout, std::cerr);
    if (bulbus::files_left_open()) leave(status, comm);
    return status;
  } catch (const std::exception& fault) {
    std::cerr << "bulbus: " << fault.what() << std::endl;
    if (comm.size() > 1 || bulbus::files_left_open())
      leave(1, comm);  // the other ranks may be waiting for this one
    return 1;
  }
}
