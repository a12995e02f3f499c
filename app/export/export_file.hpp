#pragma once
#include <fmt/format.h>

#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "core/io/disk_file.hpp"

namespace bulbus::inline app {

/// A text file that is written in pieces of a megabyte. Throws std::runtime_error. Not collective.
class ExportFile {
 public:
  explicit ExportFile(const std::string& path) : file_(path, DiskFile::Start::empty) {}

  template <class... T>
  void text(fmt::format_string<T...> pattern, T&&... values) {
    fmt::format_to(std::back_inserter(waiting_), pattern, std::forward<T>(values)...);
    if (waiting_.size() > 1000000) flush();
  }
  /// What was not written yet. To be called at the end.
  void flush() {
    file_.write(waiting_);
    waiting_.clear();
  }

 private:
  DiskFile file_;
  std::string waiting_;
};

/// A number with a decimal point in at most 20 characters, as Abaqus and CalculiX read them: exact from 0.1
/// on, below with a relative error of at most 1e-12. In exponential notation from 1e18 on, and below 1e-4
/// where it has more digits than fit.
std::string decimal(double x);

/// Whole numbers in rising order as runs of consecutive ones.
struct Run {
  int first, last;
};
std::vector<Run> runs_of(std::span<const int> sorted);

}  // namespace bulbus::inline app
