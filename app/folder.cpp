#include "app/folder.hpp"

#include <filesystem>
#include <set>
#include <vector>

#include "core/base/error.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

bool is_record(const std::string& name) {
  static const std::set<std::string> known{"summary.json",  "history.csv", "krylov.csv",
                                           "resolved.yaml", "run.log",     "result.vtkhdf.series",
                                           "bodies.pvd"};
  return known.contains(name) || (name.starts_with("result_") && name.ends_with(".vtkhdf")) ||
         (name.starts_with("bodies_") && name.ends_with(".vtp"));
}

void remove_records(const std::string& folder) {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_record(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& p : old) fs::remove(p);
}

template <class Work>
void on_first_rank(const std::string& folder, const Comm& comm, Work work) {
  comm.together([&] {
    try {
      if (comm.rank() == 0) work();
    } catch (const fs::filesystem_error& e) {
      throw input_error(folder + ": cannot be made a folder of results: " + e.code().message(),
                        "Name another with -o.");
    }
  });
}

}  // namespace

void make_folder(const std::string& folder, const Comm& comm) {
  on_first_rank(folder, comm, [&] { fs::create_directories(folder); });
}

void make_results_folder(const std::string& folder, const Comm& comm) {
  on_first_rank(folder, comm, [&] {
    fs::create_directories(folder);
    remove_records(folder);
  });
}

}  // namespace bulbus
