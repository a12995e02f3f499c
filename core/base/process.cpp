#include "core/base/process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/interrupt.hpp"

namespace bulbus {
namespace {

std::vector<std::string> environment_at_start() {
  std::vector<std::string> all;
  std::ifstream in("/proc/self/environ", std::ios::binary);
  for (std::string entry; std::getline(in, entry, '\0');)
    if (!entry.starts_with("OMP_NUM_THREADS=") && !entry.starts_with("OPENBLAS_NUM_THREADS="))
      all.push_back(entry);
  all.insert(all.end(), {"OMP_NUM_THREADS=1", "OPENBLAS_NUM_THREADS=1"});
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> p;
  for (std::string& t : texts) p.push_back(t.data());
  p.push_back(nullptr);
  return p;
}

std::string reason_of(int status) {
  if (WIFSIGNALED(status))
    return WTERMSIG(status) == SIGXCPU ? "out of time"
                                       : "ended by signal " + std::to_string(WTERMSIG(status));
  return WEXITSTATUS(status) ? "ended with status " + std::to_string(WEXITSTATUS(status)) : "";
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

Ended run_process(const std::vector<std::string>& arguments, unsigned timeout) {
  auto given = arguments, environment = environment_at_start();
  const auto argv = pointers(given), envp = pointers(environment);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {  // from here on nothing but system calls
    const int nothing = open("/dev/null", O_RDWR);
    for (int stream : {0, 1, 2}) dup2(nothing, stream);
    const rlimit most{timeout > 0 ? timeout : RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &most);  // outlives exec
    execve(argv[0], argv.data(), envp.data());
    _exit(127);
  }
  if (child < 0) return {.reason = "no process could be made"};
  int status = 0;
  rusage used{};
  pass_interrupts_to(child);
  while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
  }
  pass_interrupts_to(0);
  Ended e{.ran = WIFEXITED(status),
          .status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .reason = reason_of(status)};
  e.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  e.cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
  e.peak_mb = static_cast<double>(used.ru_maxrss) * 1024e-6;
  return e;
}

std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + "/" + name; !folder.empty() && access(file.c_str(), X_OK) == 0)
      return file;
  return "";
}

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace bulbus
