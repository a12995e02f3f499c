#include "core/base/memory.hpp"

#include <mpi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <new>

#include "core/base/memory_limits.hpp"

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

int processes() {
  int running = 0, count = 1;
  MPI_Initialized(&running);
  if (running) MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

}  // namespace

std::size_t resident_bytes() { return status_kib("VmRSS:") * 1024; }
std::size_t peak_resident_bytes() { return status_kib("VmHWM:") * 1024; }

std::size_t address_space_bytes() { return status_kib("VmSize:") * 1024; }

std::size_t machine_bytes() {
  const std::size_t physical =
      static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t process = process_limit_bytes(), ranks = static_cast<std::size_t>(processes());
  return std::min({physical, cgroup_bytes(), process > no_limit / ranks ? no_limit : ranks * process});
}

void* large_pages(std::size_t bytes) {
  constexpr std::size_t huge = std::size_t{2} << 20, line = 64;
  const bool large = bytes >= 4 * huge;  // smaller ones would waste too much of the last page
  const std::size_t page = large ? huge : line;
  void* p = std::aligned_alloc(page, (bytes + page - 1) / page * page);
  if (!p && bytes > 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (large) madvise(p, bytes, MADV_HUGEPAGE);
#endif
  return p;
}

void MemoryTally::set(const std::string& part, std::size_t bytes) {
  auto& peak = peaks_[part];
  peak = std::max(peak, bytes);
}

}  // namespace bulbus
