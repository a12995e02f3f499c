#include "core/base/error.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace bulbus {

InputError input_error(const std::string& file, int line, const std::string& what,
                       const std::string& remedy) {
  std::string place = line > 0 ? file + ":" + std::to_string(line) : file;
  return InputError(place + ": " + what + (remedy.empty() ? "" : "\n  " + remedy));
}

InputError input_error(const std::string& what, const std::string& remedy) {
  return InputError(what + (remedy.empty() ? "" : "\n  " + remedy));
}

InputError scene_error(const std::string& key, const std::string& what, const std::string& remedy) {
  return InputError(what + (remedy.empty() ? "" : "\n  " + remedy), key);
}

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      int next = std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] != b[j])});
      diagonal = row[j + 1];
      row[j + 1] = next;
    }
  }
  return row.back();
}

}  // namespace bulbus
