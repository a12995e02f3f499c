#include "app/folder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "core/base/error.hpp"
#include "core/io/text_file.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

bool is_record(const std::string& name) {
  static const std::set<std::string> known{"summary.json",  "history.csv", "krylov.csv",
                                           "resolved.yaml", "run.log",     "result.vtkhdf.series",
                                           "bodies.pvd",    "checkpoint.h5", "checkpoint.h5.tmp"};
  return known.contains(name) || (name.starts_with("result_") && name.ends_with(".vtkhdf")) ||
         (name.starts_with("bodies_") && name.ends_with(".vtp"));
}

void remove_records(const std::string& folder) {
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_record(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& p : old) fs::remove(p);
}

// The increment of a file that belongs to one, 0 of others: result_0012.vtkhdf.
int increment_of(const std::string& name) {
  if (!name.starts_with("result_") && !name.starts_with("bodies_")) return 0;
  return std::atoi(name.c_str() + name.find('_') + 1);
}

void copy_records(const std::string& from, const std::string& folder, int last) {
  for (const auto& entry : fs::directory_iterator(from))
    if (const std::string name = entry.path().filename().string(); is_record(name) && !name.starts_with("checkpoint") && increment_of(name) <= last)
      fs::copy_file(entry.path(), folder + "/" + name, fs::copy_options::overwrite_existing);
}

// Tables whose first column is the increment. A last line without an end was cut short with the run.
void cut_table(const std::string& path, int last) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return;
  std::string kept;
  bool header = true;
  for (std::string line; std::getline(in, line) && !in.eof(); header = false)
    if (header || std::atoi(line.c_str()) <= last) kept += line + "\n";
  write_whole(path, kept);
}

void remove_after(const std::string& folder, int last) {
  std::vector<fs::path> late{folder + "/summary.json"};
  for (const auto& entry : fs::directory_iterator(folder))
    if (increment_of(entry.path().filename().string()) > last) late.push_back(entry.path());
  for (const fs::path& p : late) fs::remove(p);
  for (const char* table : {"/history.csv", "/krylov.csv"}) cut_table(folder + table, last);
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

void continue_results_folder(const std::string& from, const std::string& folder, int last, const Comm& comm) {
  on_first_rank(folder, comm, [&] {
    fs::create_directories(folder);
    if (!fs::equivalent(from, folder)) {
      remove_records(folder);
      copy_records(from, folder, last);
    }
    remove_after(folder, last);
  });
}

}  // namespace bulbus
