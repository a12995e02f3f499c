#pragma once
#include <cstddef>

namespace bulbus::fuzz {

/// Lets the process say on the screen which signal ended it, also where the stack is full, and die of it.
/// `limit_seconds`: processor time of one mutant; `limit_bytes`: address space beyond what is mapped now (0,
/// or under the address sanitizer: none).
void guard_process(std::size_t limit_bytes);

/// The processor time of the next mutant begins.
void wind_up(int limit_seconds);

}  // namespace bulbus::fuzz
