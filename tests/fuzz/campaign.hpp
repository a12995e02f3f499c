#pragma once
#include <string>
#include <vector>

namespace bulbus::fuzz {

struct Options {
  unsigned long long seed = 1;
  long long first = 0, mutants = 2500;
  double seconds = 0;        ///< 0: until all mutants are tried
  std::string kind = "all";  ///< scene, study, mesh, body, checkpoint, foreign
  std::string keep;          ///< folder that receives failing mutants; empty: none
  std::string accepted;      ///< folder that receives accepted scenes
  std::string plant;         ///< see plant.hpp
  bool messages = false;     ///< print every refusal
  bool show = false;         ///< print the first mutant instead of trying it
  std::string progress;      ///< file shared with the process that started this one
};

/// What is known of the mutants of one kind; shared between processes.
struct Tally {
  long long accepted, refused, without_line, without_remedy, failures;
  double seconds;
};
inline constexpr int kinds = 6;
struct Progress {
  long long next;  ///< mutant that is tried next, or under way
  int kind;        ///< of that mutant
  bool finished;
  double start;  ///< of the campaign, by Clock::now()
  Tally tally[kinds];
};

/// Tries mutants first, first + 1, ... in this process, which may end by any of them.
void work(const Options& options, Progress& progress);

/// Starts workers, one after the other, each where the last one died; prints the tallies. Returns how many
/// mutants failed: crashes, hangs, exceptions, silence, refusals without a remedy.
long long campaign(const Options& options, const std::vector<std::string>& arguments);

}  // namespace bulbus::fuzz
