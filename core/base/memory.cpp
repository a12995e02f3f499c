#include "core/base/memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace bulbus {
namespace {

std::size_t status_kib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == key) {
      std::size_t kib = 0;
      status >> kib;
      return kib;
    }
  return 0;
}

}  // namespace

std::size_t resident_bytes() { return status_kib("VmRSS:") * 1024; }
std::size_t peak_resident_bytes() { return status_kib("VmHWM:") * 1024; }

std::size_t machine_bytes() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void MemoryTally::set(const std::string& part, std::size_t bytes) {
  auto& peak = peaks_[part];
  peak = std::max(peak, bytes);
}

}  // namespace bulbus
