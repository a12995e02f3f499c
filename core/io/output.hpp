#pragma once
#include <functional>
#include <stdexcept>
#include <string>

#include "core/base/parallel.hpp"

namespace bulbus::inline io {

/// A record that cannot be written: its file and the reason. Thrown on every rank at once.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs work of one rank or of each, which waits for no other rank; if it throws std::runtime_error anywhere,
/// every rank throws the OutputError of the lowest such rank. Collective.
void write_together(const Comm& comm, const std::function<void()>& work);

/// "path: cannot be written: no space left on the disk", from an errno. A temporary file goes by its final
/// name.
std::string not_written(std::string path, int error);

/// Is a file open that HDF5 could neither write nor close? Then the program must end without MPI_Finalize and
/// exit(): they would crash.
bool files_left_open();

}  // namespace bulbus::inline io
