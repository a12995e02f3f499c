#pragma once
#include <cstddef>
#include <map>
#include <string>

namespace bulbus {

/// Resident bytes of this process now, and the most it ever had (Linux /proc; 0 elsewhere).
std::size_t resident_bytes();
std::size_t peak_resident_bytes();
/// Bytes of memory of this machine, used or not.
std::size_t machine_bytes();

/// Bytes held by each named part of the program on this rank, with the peak of each.
class MemoryTally {
 public:
  void set(const std::string& part, std::size_t bytes);
  const std::map<std::string, std::size_t>& peaks() const { return peaks_; }

 private:
  std::map<std::string, std::size_t> peaks_;
};

/// Bytes of a vector's storage.
template <class V>
std::size_t bytes_of(const V& v) {
  return v.capacity() * sizeof(typename V::value_type);
}

}  // namespace bulbus
