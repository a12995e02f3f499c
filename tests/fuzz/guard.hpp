#pragma once
#include <cstddef>

namespace bulbus::fuzz {

/// Whether this is built with the address sanitizer: it reports crashes itself, reserves more address space
/// than any limit, and slows everything down.
#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/// What a mutant may take beyond what is mapped before.
constexpr std::size_t bytes_of_one = std::size_t{3} << 30;

/// Lets the process say on the screen which signal ended it, also where the stack is full, and die of it, and
/// limits its address space. With the sanitizer, of time only.
void guard_process();

/// The processor time of the next mutant begins.
void wind_up(int limit_seconds);

}  // namespace bulbus::fuzz
