#pragma once
#include <string>

namespace bulbus::inline io {

/// What a stream of text goes to.
struct Terminal {
  int width = 0;        ///< columns; 0: no terminal, lines are not broken
  bool colour = false;  ///< may text be coloured or bold?
};

/// Of a file descriptor. Colour on a terminal, unless NO_COLOR is set or TERM is `dumb`. A terminal without a
/// width is none: such is what mpirun gives to its processes, wherever their output goes.
Terminal terminal_of(int descriptor);

/// Columns that UTF-8 text takes: letters, not bytes.
int columns_of(const std::string& text);

/// Breaks text between words, so that no line but one of a single long word has more columns than `width`;
/// lines behind the first begin with `indent` spaces. A width of 0 leaves it as it is.
std::string wrapped(const std::string& text, int width, int indent = 0);

/// The text as it stands out on that terminal; without colour as it is.
std::string bold(const std::string& text, const Terminal& terminal);

}  // namespace bulbus::inline io
