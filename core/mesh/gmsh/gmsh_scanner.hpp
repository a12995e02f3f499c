#pragma once
#include <cstring>
#include <string>
#include <string_view>

#include "core/base/printable.hpp"

namespace bulbus::inline mesh {

/// Walks through the text or the bytes of a file and knows its line. Every failure is an InputError with that
/// line.
class GmshScanner {
 public:
  /// Reads the whole file. Throws InputError if there is none.
  explicit GmshScanner(const std::string& path);

  bool at_end();
  /// Next word of text, whitespace skipped.
  std::string_view word();
  long long integer();
  double real();
  /// A text in double quotes.
  std::string quoted();
  /// Throws unless the next word is `expected`.
  void expect(std::string_view expected);
  /// Rest of the line, its end included.
  void skip_line();
  /// To behind the next occurrence of a word at the start of a line.
  void skip_past(const std::string& marker);

  /// Raw bytes.
  template <class T>
  T bytes() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  /// `Binary` bytes, or a word of text.
  template <class Binary>
  long long number(bool binary) {
    return binary ? static_cast<long long>(bytes<Binary>()) : integer();
  }
  /// A tag, dimension or type: four bytes, or a word of text that fits them.
  int whole(bool binary);
  /// Eight bytes (text: a word), not negative.
  long long count(bool binary);
  double real(bool binary) { return binary ? bytes<double>() : real(); }

  int line() const { return line_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

 private:
  void skip_space();
  void need(std::size_t count) const;

  std::string path_, text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace bulbus::inline mesh
