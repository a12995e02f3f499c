#pragma once
#include <cctype>

namespace bulbus {

/// Space, tabulator, end of line.
inline bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Letter, digit or underscore: what names are made of.
inline bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace bulbus
