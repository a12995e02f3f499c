#pragma once
#include <string>
#include <vector>

namespace bulbus {

/// How a process ended, and what the system counted for it.
struct Ended {
  bool ran = false;  ///< to its own end, with `status`
  int status = 0;
  std::string reason;        ///< in words, of any status but 0
  double wall = 0, cpu = 0;  ///< s; processor time of user and system
  double peak_mb = 0;        ///< largest resident set
};

/// Runs a program to its end: silent, on one thread, in the environment in which this process was started
/// (MPI changes its own). What takes more than `timeout` seconds of processor time is ended; 0: never. Not
/// collective.
Ended run_process(const std::vector<std::string>& arguments, unsigned timeout = 0);

/// The file of a program that PATH leads to; empty if there is none.
std::string find_program(const std::string& name);

/// The file of the running program.
std::string this_program();

}  // namespace bulbus
