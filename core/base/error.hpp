#pragma once
#include <stdexcept>
#include <string>

namespace bulbus {

/// Wrong input: one message that names the place, the value and the remedy. The command exits with status 2.
/// `key` is the path of the scene's key that is to blame ("steps.1.increments"), where only that is known:
/// whoever knows the file adds its name and line.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message, std::string key = "")
      : std::runtime_error(message), key(std::move(key)) {}
  std::string key;
};

/// `file:line: what` followed by the remedy on a line of its own; a line of 0 is left out.
InputError input_error(const std::string& file, int line, const std::string& what, const std::string& remedy);
/// The same without a file: `what` and the remedy.
InputError input_error(const std::string& what, const std::string& remedy);
/// The same for a key of the scene.
InputError scene_error(const std::string& key, const std::string& what, const std::string& remedy);

/// The entry of `known` with the smallest edit distance to `word` (empty if none is near enough to be a
/// slip).
template <class Range>
std::string nearest(const std::string& word, const Range& known);

/// Levenshtein distance.
int edit_distance(const std::string& a, const std::string& b);

template <class Range>
std::string nearest(const std::string& word, const Range& known) {
  std::string best;
  int least = static_cast<int>(word.size()) / 2 + 1;
  for (const std::string& k : known)
    if (int d = edit_distance(word, k); d <= least && (best.empty() || d < least)) {
      least = d;
      best = k;
    }
  return best;
}

}  // namespace bulbus
