#pragma once
#include <string>
#include <vector>

#include "core/solve/settings.hpp"

namespace bulbus::bench {

/// A way to solve linear systems, as command lines name it: `direct` or `iterative` with default settings,
/// and what differs behind it, as in `direct+library=superlu_dist+ranks=2`,
/// `direct+ordering=metis+refinement=gmres` or `iterative+displacement=hybrid`. The other key is threads.
struct SolverVariant {
  std::string name;
  SolverSettings settings;
  int ranks = 1, threads = 1;
  bool direct() const { return settings.linear.method == Method::direct; }
};

/// `memory_mb`: the limit of the factors' memory; 0: the machine's. Throws std::invalid_argument.
SolverVariant solver_variant(const std::string& name, double memory_mb);

/// Its settings alone.
inline SolverSettings settings_of(const std::string& name, double memory_mb) {
  return solver_variant(name, memory_mb).settings;
}

/// Names parted by commas; of `all`, those that a comparison of direct solvers makes with what is built in.
std::vector<std::string> variants_in(const std::string& list);

}  // namespace bulbus::bench
