#pragma once
// Counts every allocation by `new` of the program; for one source of a program only, since it replaces the
// operators. Out of line, so that the compiler does not pair malloc with delete.
#include <cstdlib>
#include <new>

namespace bulbus {

inline long long allocations = 0;

/// Allocations that some work makes.
template <class Work>
long long allocated(Work work) {
  const long long before = allocations;
  work();
  return allocations - before;
}

}  // namespace bulbus

[[gnu::noinline]] void* operator new(std::size_t size) {
  ++bulbus::allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t align) {
  ++bulbus::allocations;
  const std::size_t to = static_cast<std::size_t>(align);
  if (void* p = std::aligned_alloc(to, (size + to - 1) / to * to)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
