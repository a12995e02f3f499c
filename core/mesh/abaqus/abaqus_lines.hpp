#pragma once
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bulbus::inline mesh {

/// A line of the input file or of one that it includes.
struct AbaqusPlace {
  int file = 0, line = 0;
};

std::string in_capitals(std::string_view text);

/// `*NAME, KEY=value, KEY`: name and keys in capitals, values as they stand, without quotes.
struct AbaqusKeyword {
  std::string name;
  std::vector<std::pair<std::string, std::string>> parameters;
  AbaqusPlace place;
  /// Null if the parameter is not given.
  const std::string* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key); }
};

/// Walks through the lines of an input file that are neither empty nor a comment, into and out of *INCLUDE.
class AbaqusLines {
 public:
  /// Throws InputError if the file cannot be read.
  explicit AbaqusLines(const std::string& path);

  bool at_end() const { return open_.empty(); }
  /// At a data line, not at a keyword or the end.
  bool at_data() const { return !at_end() && line_[0] != '*'; }
  void next();
  /// The keyword of this line and of those that it continues on; goes to the line behind them.
  AbaqusKeyword keyword();
  /// Words of this data line between commas, without blanks around them, empty ones at its end left out.
  const std::vector<std::string_view>& fields();
  /// The line ends with a comma.
  bool continues() const { return line_.back() == ','; }

  int label(std::string_view word) const;
  double real(std::string_view word) const;
  /// A name without its quotes.
  static std::string name(std::string_view word);

  AbaqusPlace place() const;
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;
  [[noreturn]] void fail(const AbaqusPlace& at, const std::string& what, const std::string& remedy) const;
  /// Paths, as AbaqusPlace counts them.
  const std::vector<std::string>& files() const { return files_; }

 private:
  struct Open {
    int file;
    std::size_t at = 0;
    int line = 0;
  };
  bool take_line();
  void include(const AbaqusKeyword& keyword);
  void open(const std::string& path);
  AbaqusKeyword parse(std::string_view text, const AbaqusPlace& place) const;

  std::vector<std::string> files_;
  std::deque<std::string> texts_;
  std::vector<Open> open_;  ///< the innermost is the last
  std::string_view line_;   ///< without blanks around it
  std::vector<std::string_view> fields_;
  AbaqusPlace last_;
};

}  // namespace bulbus::inline mesh
