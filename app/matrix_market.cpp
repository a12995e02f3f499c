#include <filesystem>
#include <ostream>

#include "app/commands.hpp"
#include "core/base/error.hpp"
#include "core/solve/dump.hpp"

namespace bulbus::inline app {

int matrix_market(const std::string& dump, std::string file, const Comm& comm, std::ostream& out) {
  if (file.empty()) file = std::filesystem::path(dump).replace_extension(".mtx").string();
  if (std::filesystem::path(file).extension() != ".mtx")
    throw input_error("'" + file + "' is no name of a Matrix Market file", "end it in .mtx");
  comm.together([&] {
    if (comm.rank() > 0) return;
    for (const std::string& name : write_matrix_market(file, read_system(dump))) out << name << "\n";
  });
  return 0;
}

}  // namespace bulbus::inline app
