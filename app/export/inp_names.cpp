#include "app/export/inp_names.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/base/characters.hpp"

namespace bulbus::inline app {
namespace {

std::string plain(const std::string& name) {
  std::string text = name.substr(0, 76);  // room for a number behind it
  for (char& c : text)
    if (!is_word(c) && c != '-' && c != '.') c = '_';
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) ? text : "N" + text;
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

InpNames::InpNames(const std::string& kind, const std::vector<std::string>& names,
                   std::vector<std::string>& notes) {
  std::set<std::string> taken;
  for (const std::string& name : names) {
    const std::string first = plain(name);
    std::string free = first;
    for (int k = 2; !taken.insert(capitals(free)).second; ++k) free = first + "_" + std::to_string(k);
    if (free != name) notes.push_back(kind + " '" + name + "' goes by the name " + free);
    given_[name] = free;
  }
}

}  // namespace bulbus::inline app
