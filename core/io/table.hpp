#pragma once
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/io/disk_file.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline io {

/// A table that grows row by row: header first, every row whole on the disk or not at all, twelve significant
/// digits. Not collective.
class CsvTable {
 public:
  using Cell = std::variant<double, long long, std::string>;

  /// A file that is continued keeps its rows, if it has any. Throws std::runtime_error.
  CsvTable(std::string path, const std::vector<std::string>& columns, FileStart start = FileStart::anew);
  /// Throws std::invalid_argument if there are not as many cells as columns, std::runtime_error if the disk
  /// is full.
  void append(const std::vector<Cell>& row);

 private:
  void write_line(const std::vector<Cell>& row);

  std::string path_;
  std::size_t width_;
  std::unique_ptr<DiskFile> out_;
};

/// Cuts a table whose first column is a number in rising order: rows after `last` go, and a last one that was
/// cut short. Nothing where there is no file. Throws std::runtime_error. Not collective.
void cut_table(const std::string& path, int last);

/// Takes away the last line of a text if it has no end. Nothing where there is no file. Throws
/// std::runtime_error. Not collective.
void cut_half_line(const std::string& path);

}  // namespace bulbus::inline io
