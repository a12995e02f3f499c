#include "tests/fuzz/campaign.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "core/base/clock.hpp"
#include "core/base/process.hpp"

namespace bulbus::fuzz {
namespace {

namespace fs = std::filesystem;

int wait_for_worker(std::vector<std::string> arguments, const std::string& progress) {
  arguments.insert(arguments.begin(), this_program());
  arguments.insert(arguments.end(), {"--progress", progress});
  std::vector<char*> words;
  for (std::string& a : arguments) words.push_back(a.data());
  words.push_back(nullptr);
  std::cout << std::flush;
  const pid_t child = fork();
  if (child == 0) {
    execv(words[0], words.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void print(const Progress& p, double seconds) {
  static const char* const names[kinds] = {"scene", "study", "mesh", "body", "checkpoint", "foreign"};
  std::cout << fmt::format("{:<11}{:>9}{:>9}{:>9}{:>13}{:>16}{:>9}{:>12}\n", "kind", "mutants", "accepted",
                           "refused", "without line", "without remedy", "failed", "ms each");
  long long all = 0;
  for (int k = 0; k < kinds; ++k) {
    const Tally& t = p.tally[k];
    const long long count = t.accepted + t.refused + t.failures;
    all += count;
    if (count > 0)
      std::cout << fmt::format("{:<11}{:>9}{:>9}{:>9}{:>13}{:>16}{:>9}{:>12.2f}\n", names[k], count,
                               t.accepted, t.refused, t.without_line, t.without_remedy, t.failures,
                               1e3 * t.seconds / static_cast<double>(count));
  }
  std::cout << fmt::format("{} mutants in {:.1f} s\n", all, seconds);
}

}  // namespace

long long campaign(const Options& options, const std::vector<std::string>& arguments) {
  const std::string name = fs::temp_directory_path() / fmt::format("bulbus_fuzz_{}", getpid());
  const int file = open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ftruncate(file, sizeof(Progress)) != 0)
    throw std::runtime_error(name + ": cannot be written");
  auto* progress =
      static_cast<Progress*>(mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  if (progress == MAP_FAILED) throw std::runtime_error(name + ": cannot be mapped");
  close(file);
  progress->next = options.first;
  const double start = progress->start = Clock::now();
  while (!progress->finished) {
    const int status = wait_for_worker(arguments, name);
    if (progress->finished) break;
    const long long mutant = progress->next++;
    ++progress->tally[progress->kind].failures;
    std::cout
        << fmt::format(
               "FAILED mutant {} ended the process (status {}); again: --seed {} --first {} --mutants {}",
               mutant, status, options.seed, mutant, mutant + 1)
        << std::endl;
    if (options.seconds > 0 && Clock::now() - start > options.seconds) break;
  }
  print(*progress, Clock::now() - start);
  long long failed = 0;
  for (const Tally& t : progress->tally) failed += t.failures + t.without_remedy;
  if (failed > 0) std::cout << failed << " mutants failed (seed " << options.seed << ")" << std::endl;
  munmap(progress, sizeof(Progress));
  fs::remove(name);
  fs::remove_all(fs::path("/dev/shm") / fmt::format("bulbus_fuzz_{}", getpid()));
  return failed;
}

}  // namespace bulbus::fuzz
