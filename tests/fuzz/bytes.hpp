#pragma once
#include <string>

#include "tests/fuzz/random.hpp"

namespace bulbus::fuzz {

/// Values that programs stumble over: extremes, no numbers, wrong kinds, foreign units.
const std::vector<std::string>& awkward_words();

/// One to four small faults: bits, bytes, words, lines, and numbers put in place of others. `binary`: also
/// integers and reals in place of aligned bytes.
std::string with_faults(std::string bytes, bool binary, Random& random);

}  // namespace bulbus::fuzz
