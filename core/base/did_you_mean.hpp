#pragma once
#include <cctype>

#include "core/base/error.hpp"

namespace bulbus {

/// The remedy for a name that is not among `names`: the nearest one of them if `word` may be a slip for it,
/// `otherwise` if not; with a capital letter where that has one.
template <class Names>
std::string did_you_mean(const std::string& word, const Names& names, const std::string& otherwise) {
  const std::string near = nearest(word, names);
  if (near.empty()) return otherwise;
  const bool capital = !otherwise.empty() && std::isupper(static_cast<unsigned char>(otherwise[0]));
  return std::string(capital ? "Did" : "did") + " you mean '" + near + "'?";
}

}  // namespace bulbus
