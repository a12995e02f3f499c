#pragma once
#include <string>

#include "tests/fuzz/target.hpp"

namespace bulbus::fuzz {

/// How one mutant ended.
struct Verdict {
  enum class Kind { accepted, refused, failure };
  Kind kind = Kind::accepted;
  std::string message;  ///< of the refusal or failure
  bool has_line = true,
       has_remedy =
           true;  ///< of a refusal: begins with file and line (binary: names the entry), has a second line
};

/// Anything but acceptance and InputError is a failure.
Verdict verdict_on(const Target& target, const Mutant& mutant);

}  // namespace bulbus::fuzz
