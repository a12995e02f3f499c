#pragma once
#include <string>

namespace bulbus::fuzz {

/// A fault put into the program under test, so that a test can tell whether it is found: `exception`,
/// `crash`, `stack`, `hang`, `memory`, `silent` or `no_remedy`; empty: none. It strikes at mutants 13, 113,
/// 213, ...
void strike(const std::string& plant, long long index);

}  // namespace bulbus::fuzz
