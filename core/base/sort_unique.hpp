#pragma once
#include <algorithm>
#include <vector>

namespace bulbus {

/// Puts values in rising order, each once.
template <class T>
void sort_unique(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace bulbus
