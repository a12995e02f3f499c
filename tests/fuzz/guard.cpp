#include "tests/fuzz/guard.hpp"

#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "core/base/memory.hpp"

namespace bulbus::fuzz {
namespace {

void say(int signal) {
  const char* what = signal == SIGPROF   ? "HANG: the time of one mutant is over\n"
                     : signal == SIGSEGV ? "CRASH: segmentation fault\n"
                     : signal == SIGFPE  ? "CRASH: arithmetic fault\n"
                                         : "CRASH: abort, bus error or illegal instruction\n";
  if (write(STDERR_FILENO, what, std::strlen(what)) < 0) _exit(4);
  _exit(3);
}

}  // namespace

void guard_process() {
  static char stack[1 << 16];
  const stack_t other{.ss_sp = stack, .ss_flags = 0, .ss_size = sizeof stack};
  sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = say;
  action.sa_flags = SA_ONSTACK;
  sigaction(SIGPROF, &action, nullptr);
  if (sanitized) return;
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(signal, &action, nullptr);
  const rlimit limit{address_space_bytes() + bytes_of_one, RLIM_INFINITY};
  setrlimit(RLIMIT_AS, &limit);
}

void wind_up(int limit_seconds) {
  const itimerval timer{{0, 0}, {limit_seconds, 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace bulbus::fuzz
