#include "core/mesh/gmsh/gmsh_scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/characters.hpp"
#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/whole_file.hpp"

namespace bulbus::inline mesh {
namespace {

const char* const save_again = "save the mesh again as MSH 4.1 or 2.2";

}

GmshScanner::GmshScanner(const std::string& path) : path_(path), text_(whole_file(path, "mesh file")) {}

void GmshScanner::fail(const std::string& what, const std::string& remedy) const {
  throw input_error(path_, line_, what, remedy);
}

void GmshScanner::need(std::size_t count) const {
  if (text_.size() - at_ < count) fail("the file ends too early", save_again);
}

void GmshScanner::skip_space() {
  for (; at_ < text_.size() && is_blank(text_[at_]); ++at_)
    if (text_[at_] == '\n') ++line_;
}

bool GmshScanner::at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view GmshScanner::word() {
  skip_space();
  need(1);
  const std::size_t start = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return std::string_view(text_).substr(start, at_ - start);
}

long long GmshScanner::integer() {
  const std::string_view w = word();
  const auto value = parse_number<long long>(w);
  if (!value) fail(fmt::format("'{}' is no whole number", printable(w)), save_again);
  return *value;
}

double GmshScanner::real() {
  const std::string_view w = word();
  const auto value = parse_number<double>(w);
  if (!value) fail(fmt::format("'{}' is no number", printable(w)), save_again);
  return *value;
}

int GmshScanner::whole(bool binary) {
  const long long value = number<int>(binary);
  constexpr int most = std::numeric_limits<int>::max();  // -most - 1 has no opposite
  if (value < -most || value > most) fail(fmt::format("{} is too large for a tag", value), save_again);
  return static_cast<int>(value);
}

long long GmshScanner::count(bool binary) {
  const long long value = number<long long>(binary);
  if (value < 0) fail(fmt::format("a number of entries is negative: {}", value), save_again);
  return value;
}

std::string GmshScanner::quoted() {
  skip_space();
  need(1);
  const std::size_t end = text_.find('"', at_ + 1);
  if (text_[at_] != '"' || end == std::string::npos) fail("a name in double quotes is missing", save_again);
  const std::string name = text_.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  return name;
}

void GmshScanner::expect(std::string_view expected) {
  const std::string_view w = word();
  if (w != expected)
    fail(fmt::format("expected {}, found '{}'", printable(expected), printable(w)), save_again);
}

void GmshScanner::skip_line() {
  at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
  ++line_;
}

void GmshScanner::skip_past(const std::string& marker) {
  const std::size_t found = text_.find("\n" + marker, at_ == 0 ? 0 : at_ - 1);
  if (found == std::string::npos) fail(printable(marker) + " is missing", save_again);
  for (; at_ < found + 1 + marker.size(); ++at_)
    if (text_[at_] == '\n') ++line_;
}

}  // namespace bulbus::inline mesh
