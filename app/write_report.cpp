#include "app/commands.hpp"
#include "app/report/report.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {

std::string report(const std::string& folder, const std::string& second, const std::string& file,
                   const Comm& comm) {
  std::string path;
  comm.together([&] {
    if (comm.rank() != 0) return;
    try {
      path = write_report(folder, second, file);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& fault) {
      throw OutputError(fault.what());
    }
  });
  return path;
}

}  // namespace bulbus::inline app
