#include "core/io/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace bulbus::inline io {
namespace {

bool is_given(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

bool is_dumb() {
  const char* term = std::getenv("TERM");
  return !term || std::string_view(term) == "dumb";
}

}  // namespace

Terminal terminal_of(int descriptor) {
  winsize size{};
  if (!isatty(descriptor) || ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return {};
  return {size.ws_col, !is_given("NO_COLOR") && !is_dumb()};
}

int columns_of(const std::string& text) {
  return static_cast<int>(std::ranges::count_if(text, [](unsigned char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, int width, int indent) {
  if (width <= 0) return text;
  std::istringstream in(text);
  std::string out;
  int column = 0;
  for (std::string word; in >> word;) {
    const int length = columns_of(word);
    if (!out.empty() && column + 1 + length > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!out.empty()) {
      out += ' ';
      ++column;
    }
    out += word;
    column += length;
  }
  return out;
}

std::string bold(const std::string& text, const Terminal& terminal) {
  return terminal.colour ? "\033[1m" + text + "\033[0m" : text;
}

}  // namespace bulbus::inline io
