#pragma once
#include <sys/types.h>

#include "core/base/parallel.hpp"

namespace bulbus {

/// While it lives, a first SIGINT or SIGTERM is kept for the next safe point; a second one ends the program
/// at once. One inside of another changes nothing.
class InterruptsHeeded {
 public:
  InterruptsHeeded();
  ~InterruptsHeeded();
  InterruptsHeeded(const InterruptsHeeded&) = delete;
  InterruptsHeeded& operator=(const InterruptsHeeded&) = delete;
};

/// The signal that has come to this rank, 0 if none has.
int interrupt_here();
/// The signal that has come to any rank, 0 if none has. Collective.
int interrupt(const Comm& comm);
/// "SIGINT" or "SIGTERM".
const char* name_of_interrupt(int signal);
/// Signals are passed on to this process as well; 0: to none.
void pass_interrupts_to(pid_t process);

/// What ends work that lasts, from the middle of it. Thrown on every rank at once.
struct Interruption {
  int signal;
};

}  // namespace bulbus
