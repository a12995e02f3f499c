#include "core/io/table.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace bulbus::inline io {
namespace {

// RFC 4180: a cell with a comma, a quote or a line's end is quoted, its quotes doubled.
std::string text_of(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string out = "\"";
  for (char c : cell) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}
std::string text_of(double cell) { return fmt::format("{:.12g}", cell); }
std::string text_of(long long cell) { return fmt::format("{}", cell); }

}  // namespace

CsvTable::CsvTable(std::string path, const std::vector<std::string>& columns, FileStart start)
    : path_(std::move(path)), width_(columns.size()) {
  const bool goes_on = start == FileStart::continued && std::ifstream(path_).peek() != EOF;
  out_ = std::make_unique<DiskFile>(path_, goes_on ? DiskFile::Start::end : DiskFile::Start::empty);
  if (!goes_on) write_line({columns.begin(), columns.end()});
}

void CsvTable::append(const std::vector<Cell>& row) {
  if (row.size() != width_)
    throw std::invalid_argument(fmt::format("{}: {} cells for {} columns", path_, row.size(), width_));
  write_line(row);
}

void CsvTable::write_line(const std::vector<Cell>& row) {
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i)
    line += (i ? "," : "") + std::visit([](const auto& cell) { return text_of(cell); }, row[i]);
  out_->write(line + "\n");
}

void cut_table(const std::string& path, int last) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return;
  std::string kept;
  bool header = true;
  for (std::string line; std::getline(in, line) && !in.eof(); header = false)
    if (header || std::atoi(line.c_str()) <= last) kept += line + "\n";
  write_whole(path, kept);
}

void cut_half_line(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!text.empty() && text.back() != '\n') write_whole(path, text.substr(0, text.rfind('\n') + 1));
}

}  // namespace bulbus::inline io
