#pragma once
#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "core/io/text_file.hpp"

namespace bulbus {

/// A table that grows row by row: header first, every row flushed, twelve significant digits. Not collective.
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
  std::ofstream out_;
};

}  // namespace bulbus
