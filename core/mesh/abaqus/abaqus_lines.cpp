#include "core/mesh/abaqus/abaqus_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/base/whole_file.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr std::size_t most_files = 1000;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // of UTF-8, as editors on Windows write it

std::string_view trimmed(std::string_view text) {
  const std::string_view blanks = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The words between commas that stand outside of quotes.
void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != ',')) continue;
    words.push_back(trimmed(line.substr(start, i - start)));
    start = i + 1;
  }
  while (!words.empty() && words.back().empty()) words.pop_back();
}

}  // namespace

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

const std::string* AbaqusKeyword::find(std::string_view key) const {
  const auto at = std::ranges::find(parameters, key, &std::pair<std::string, std::string>::first);
  return at == parameters.end() ? nullptr : &at->second;
}

AbaqusLines::AbaqusLines(const std::string& path) {
  open(path);
  next();
}

void AbaqusLines::open(const std::string& path) {
  texts_.push_back(whole_file(path, "mesh file"));
  if (texts_.back().starts_with(byte_order_mark)) texts_.back().erase(0, byte_order_mark.size());
  files_.push_back(path);
  open_.push_back({static_cast<int>(files_.size()) - 1});
}

bool AbaqusLines::take_line() {
  Open& file = open_.back();
  const std::string& text = texts_[file.file];
  if (file.at >= text.size()) return false;
  const std::size_t end = std::min(text.find('\n', file.at), text.size());
  line_ = trimmed(std::string_view(text).substr(file.at, end - file.at));
  file.at = end + 1;
  ++file.line;
  last_ = {file.file, file.line};
  return true;
}

void AbaqusLines::next() {
  while (!open_.empty()) {
    if (!take_line()) {
      open_.pop_back();
      continue;
    }
    if (line_.empty() || line_.starts_with("**")) continue;
    if (in_capitals(line_.substr(0, 8)) != "*INCLUDE") return;
    include(parse(line_, last_));
  }
}

void AbaqusLines::include(const AbaqusKeyword& keyword) {
  namespace fs = std::filesystem;
  const std::string* input = keyword.find("INPUT");
  if (!input || input->empty()) fail("*INCLUDE names no file", "write *INCLUDE, INPUT=FILE");
  const std::string path =
      (fs::path(files_[open_.back().file]).parent_path() / *input).lexically_normal().string();
  std::error_code failure;
  if (input->find('\0') != std::string::npos || !fs::is_regular_file(path, failure))
    fail(fmt::format("*INCLUDE names '{}', which is no file", printable(*input, true)),
         "give its path from the folder of the file that includes it");
  if (std::ranges::any_of(open_, [&](const Open& o) { return files_[o.file] == path; }))
    fail(fmt::format("'{}' includes itself", printable(*input, true)), "take the *INCLUDE out");
  if (files_.size() == most_files)
    fail(fmt::format("more than {} files are included", most_files), "put them together");
  open(path);
}

AbaqusKeyword AbaqusLines::parse(std::string_view text, const AbaqusPlace& place) const {
  std::vector<std::string_view> words;
  split(text.substr(1), words);
  AbaqusKeyword keyword;
  keyword.place = place;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i == 0) {
      for (char c : in_capitals(words[0]))
        if (c != ' ' && c != '\t')
          keyword.name += c;
        else if (keyword.name.back() != ' ')
          keyword.name += ' ';
      continue;
    }
    const std::size_t equals = words[i].find('=');
    const bool has_value = equals != std::string_view::npos;
    if (!words[i].empty() && std::string_view("0123456789.-+").find(words[i][0]) != std::string_view::npos)
      fail(keyword.place,
           fmt::format("*{} continues with the number '{}'", printable(keyword.name), printable(words[i])),
           "end its line without a comma");
    keyword.parameters.emplace_back(in_capitals(trimmed(words[i].substr(0, equals))),
                                    has_value ? name(trimmed(words[i].substr(equals + 1))) : "");
  }
  return keyword;
}

AbaqusKeyword AbaqusLines::keyword() {
  std::string text(line_);
  const AbaqusPlace place = last_;
  while (text.back() == ',') {
    next();
    if (!at_data()) break;
    text += line_;
  }
  if (text.back() != ',' || at_data()) next();
  return parse(text, place);
}

const std::vector<std::string_view>& AbaqusLines::fields() {
  split(line_, fields_);
  return fields_;
}

int AbaqusLines::label(std::string_view word) const {
  const auto value = parse_number<int>(word);
  if (!value || *value < 1)
    fail(fmt::format("'{}' is no number of a node or element", printable(word)),
         "they are whole numbers from 1 to 2147483647");
  return *value;
}

double AbaqusLines::real(std::string_view word) const {
  std::string text(word.starts_with('+') ? word.substr(1) : word);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';  // as Fortran writes it
  const auto value = parse_number<double>(text);
  if (!value || !std::isfinite(*value))
    fail(fmt::format("'{}' is no finite number", printable(word)), "write numbers such as 1.5 or 2e-3");
  return *value;
}

std::string AbaqusLines::name(std::string_view word) {
  if (word.size() >= 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
  return std::string(word);
}

AbaqusPlace AbaqusLines::place() const { return last_; }

void AbaqusLines::fail(const std::string& what, const std::string& remedy) const {
  fail(last_, what, remedy);
}

void AbaqusLines::fail(const AbaqusPlace& at, const std::string& what, const std::string& remedy) const {
  throw input_error(files_[at.file], at.line, what, remedy);
}

}  // namespace bulbus::inline mesh
