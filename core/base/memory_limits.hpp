#pragma once
#include <cstddef>
#include <limits>
#include <string>

namespace bulbus {

inline constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// Bytes that the control groups of this process allow all of their processes together: the least on the way
/// up, of version 1 or 2. `proc` is the folder with the files `cgroup` and `mountinfo` of a process. no_limit
/// where there is none.
std::size_t cgroup_bytes(const std::string& proc = "/proc/self");

/// Bytes that this process may hold by its limits of address space and data (ulimit -v, -d), less what it has
/// mapped but does not hold. no_limit where there is none.
std::size_t process_limit_bytes();

}  // namespace bulbus
