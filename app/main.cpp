#include <exception>
#include <iostream>

#include "app/command_line.hpp"

int main(int argc, char** argv) {
  const bulbus::Session session(argc, argv);
  const bulbus::Comm comm;
  try {
    return bulbus::command_line({argv + 1, argv + argc}, comm, std::cout, std::cerr);
  } catch (const std::exception& fault) {
    std::cerr << "bulbus: " << fault.what() << std::endl;
    if (comm.size() > 1) MPI_Abort(comm.raw(), 1);  // the other ranks may be waiting for this one
    return 1;
  }
}
