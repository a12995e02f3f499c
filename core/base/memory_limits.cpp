#include "core/base/memory_limits.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "core/base/memory.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

// Where a hierarchy of control groups can be seen: its group `root` is the folder `folder`.
struct Mount {
  std::string root, folder;
  bool version2;
};

bool has_word(const std::string& list, const std::string& word) {
  return ("," + list + ",").find("," + word + ",") != std::string::npos;
}

// proc(5): id parent device root folder options ... - type source options
std::vector<Mount> mounts_of_memory(const std::string& proc) {
  std::vector<Mount> mounts;
  std::ifstream file(proc + "/mountinfo");
  for (std::string line; std::getline(file, line);) {
    const auto dash = line.find(" - ");
    if (dash == std::string::npos) continue;
    std::istringstream before(line.substr(0, dash)), behind(line.substr(dash + 3));
    std::string id, parent, device, root, folder, type, source, options;
    before >> id >> parent >> device >> root >> folder;
    behind >> type >> source >> options;
    if (type == "cgroup2" || (type == "cgroup" && has_word(options, "memory")))
      mounts.push_back({root, folder, type == "cgroup2"});
  }
  return mounts;
}

// Lines `number:controllers:/path`; version 2 has no controllers. The path of this process in a hierarchy.
std::optional<std::string> group_in(const std::string& proc, bool version2) {
  std::ifstream file(proc + "/cgroup");
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (version2 ? controllers.empty() : has_word(controllers, "memory")) return line.substr(second + 1);
  }
  return {};
}

// Version 2 writes `max` where there is no limit; version 1 a number beyond any memory.
std::size_t limit_in(const fs::path& group, bool version2) {
  std::ifstream file(group / (version2 ? "memory.max" : "memory.limit_in_bytes"));
  unsigned long long bytes = 0;
  return file >> bytes ? static_cast<std::size_t>(bytes) : no_limit;
}

// In a container the path may be told as the host sees it, above what is mounted: then what is mounted is the
// group.
fs::path folder_of(const Mount& mount, const std::string& group) {
  const fs::path below = fs::path(group).lexically_relative(mount.root);
  return below.empty() || *below.begin() == ".." ? fs::path(mount.folder)
                                                 : (mount.folder / below).lexically_normal();
}

std::size_t least_above(const Mount& mount, const std::string& group) {
  std::size_t least = limit_in(mount.folder, mount.version2);
  for (fs::path at = folder_of(mount, group); at.string().size() > mount.folder.size(); at = at.parent_path())
    least = std::min(least, limit_in(at, mount.version2));
  return least;
}

std::size_t soft_limit(int resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY
             ? no_limit
             : static_cast<std::size_t>(limit.rlim_cur);
}

}  // namespace

std::size_t cgroup_bytes(const std::string& proc) {
  std::size_t least = no_limit;
  for (const Mount& mount : mounts_of_memory(proc))
    if (const auto group = group_in(proc, mount.version2))
      least = std::min(least, least_above(mount, *group));
  return least;
}

std::size_t process_limit_bytes() {
  const std::size_t data = soft_limit(RLIMIT_DATA), space = soft_limit(RLIMIT_AS);
  if (space == no_limit) return data;
  const std::size_t mapped = address_space_bytes(), held = resident_bytes(),
                    idle = mapped > held ? mapped - held : 0;
  return std::min(data, space > idle ? space - idle : 0);
}

}  // namespace bulbus
