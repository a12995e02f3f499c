#pragma once
#include <span>
#include <vector>

#include "core/base/parallel.hpp"

namespace bulbus::inline mesh {

/// Counts of the keys 0, 1, ... all − 1, given in pieces by all ranks, summed up in the order of the keys.
/// Each rank keeps a run of the keys.
class RunningSums {
 public:
  /// Counts of keys that no rank gives are 0. Collective.
  RunningSums(std::span<const int> keys, std::span<const int> counts, long long all, const Comm& comm);
  /// Per key, the sum over all smaller keys. Collective.
  std::vector<long long> before(std::span<const int> keys) const;
  long long total() const { return total_; }

 private:
  int keeper_of(int key) const { return static_cast<int>(key / run_); }

  Comm comm_;
  long long run_, total_;          // keys per rank
  std::vector<long long> before_;  // per key that this rank keeps
};

}  // namespace bulbus::inline mesh
