#include "core/io/markup.hpp"

namespace bulbus::inline io {

std::string escaped_markup(const std::string& text) {
  std::string escaped;
  for (char c : text)
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  return escaped;
}

}  // namespace bulbus::inline io
