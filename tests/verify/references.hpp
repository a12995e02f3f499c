#pragma once
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bulbus {

/// One row of a table of data/references, by column name.
struct ReferenceRow {
  std::map<std::string, std::string> cells;
  const std::string& text(const std::string& column) const { return cells.at(column); }
  double operator[](const std::string& column) const { return std::stod(cells.at(column)); }
};

inline std::vector<std::string> split_cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// All rows of data/references/NAME; lines that begin with # are remarks, the first other one names the
/// columns.
inline std::vector<ReferenceRow> references(const std::string& name) {
  const std::string path = std::string(BULBUS_DATA) + "/references/" + name;
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> header;
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto cells = split_cells(line);
    if (header.empty()) {
      header = cells;
      continue;
    }
    ReferenceRow row;
    for (std::size_t i = 0; i < header.size(); ++i) row.cells[header[i]] = cells.at(i);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace bulbus
