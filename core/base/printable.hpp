#pragma once
#include <string>
#include <string_view>

namespace bulbus {

/// At most 40 characters of a word of a file as a message shows them: control characters become '?', and so
/// does what is not ASCII unless it is `utf8`.
inline std::string printable(std::string_view word, bool utf8 = false) {
  std::string text(word.substr(0, 40));
  for (char& c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < ' ' || code == 127 || (code > 127 && !utf8)) c = '?';
  }
  return word.size() > 40 ? text + "..." : text;
}

}  // namespace bulbus
