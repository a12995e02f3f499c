#include "core/base/interrupt.hpp"

#include <signal.h>

#include <atomic>

namespace bulbus {
namespace {

std::atomic<int> came{0};
std::atomic<pid_t> heir{0};
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<pid_t>::is_always_lock_free);  // handlers may use these
int depth = 0;
struct sigaction before_int, before_term;

extern "C" void keep_interrupt(int number) {
  came = number;
  if (const pid_t process = heir; process > 0) kill(process, number);
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
}

}  // namespace

InterruptsHeeded::InterruptsHeeded() {
  if (depth++ > 0) return;
  came = 0;
  struct sigaction heed {};
  heed.sa_handler = keep_interrupt;
  heed.sa_flags = SA_RESTART;
  sigemptyset(&heed.sa_mask);
  sigaction(SIGINT, &heed, &before_int);
  sigaction(SIGTERM, &heed, &before_term);
}

InterruptsHeeded::~InterruptsHeeded() {
  if (--depth > 0) return;
  sigaction(SIGINT, &before_int, nullptr);
  sigaction(SIGTERM, &before_term, nullptr);
  came = 0;
}

int interrupt_here() { return came; }

int interrupt(const Comm& comm) { return static_cast<int>(comm.max(static_cast<double>(came))); }

const char* name_of_interrupt(int signal) { return signal == SIGINT ? "SIGINT" : "SIGTERM"; }

void pass_interrupts_to(pid_t process) { heir = process; }

}  // namespace bulbus
