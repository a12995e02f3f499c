#pragma once
#include <cstddef>
#include <cstdlib>
#include <map>
#include <string>

namespace bulbus {

inline constexpr double megabyte = 1e6;  ///< bytes

/// Resident bytes of this process now, and the most it ever had (Linux /proc; 0 elsewhere).
std::size_t resident_bytes();
std::size_t peak_resident_bytes();
/// Bytes of address space of this process (Linux /proc; 0 elsewhere).
std::size_t address_space_bytes();
/// Bytes of memory that all ranks may take on this machine, used or not: what it has, what control groups
/// allow, or the ranks' limits of the shell (ulimit) together, whichever is least.
std::size_t machine_bytes();

/// Memory for LargePages, to be freed with std::free. Throws std::bad_alloc.
void* large_pages(std::size_t bytes);

/// Bytes held by each named part of the program on this rank, with the peak of each.
class MemoryTally {
 public:
  void set(const std::string& part, std::size_t bytes);
  const std::map<std::string, std::size_t>& peaks() const { return peaks_; }

 private:
  std::map<std::string, std::size_t> peaks_;
};

/// Storage in pages of 2 MB where the system has them: for large arrays that are read from end to end, again
/// and again.
template <class T>
struct LargePages {
  using value_type = T;
  T* allocate(std::size_t n) { return static_cast<T*>(large_pages(n * sizeof(T))); }
  void deallocate(T* p, std::size_t) { std::free(p); }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

/// Bytes of a vector's storage.
template <class V>
std::size_t bytes_of(const V& v) {
  return v.capacity() * sizeof(typename V::value_type);
}

}  // namespace bulbus
