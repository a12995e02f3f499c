#include "core/mesh/running_sums.hpp"

#include <utility>

namespace bulbus::inline mesh {

RunningSums::RunningSums(std::span<const int> keys, std::span<const int> counts, long long all,
                         const Comm& comm)
    : comm_(comm), run_(all / comm.size() + 1), before_(run_) {
  std::vector<std::vector<long long>> given(comm.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (counts[i] != 0)
      given[keeper_of(keys[i])].insert(given[keeper_of(keys[i])].end(), {keys[i], counts[i]});
  const long long first = run_ * comm.rank();
  for (const auto& pairs : comm.exchange(given))
    for (std::size_t i = 0; i < pairs.size(); i += 2) before_[pairs[i] - first] += pairs[i + 1];
  long long sum = 0;
  for (long long& b : before_) b = std::exchange(sum, sum + b);
  const long long offset = comm.offset(sum);
  for (long long& b : before_) b += offset;
  total_ = comm.sum(sum);
}

std::vector<long long> RunningSums::before(std::span<const int> keys) const {
  std::vector<std::vector<long long>> asked(comm_.size());
  for (int key : keys) asked[keeper_of(key)].push_back(key);
  auto answers = comm_.exchange(asked);
  const long long first = run_ * comm_.rank();
  for (auto& list : answers)
    for (long long& key : list) key = before_[key - first];
  answers = comm_.exchange(answers);
  std::vector<long long> sums;
  std::vector<std::size_t> next(comm_.size());
  for (int key : keys) sums.push_back(answers[keeper_of(key)][next[keeper_of(key)]++]);
  return sums;
}

}  // namespace bulbus::inline mesh
