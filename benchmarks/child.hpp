#pragma once
#include <functional>

#include "benchmarks/common.hpp"

namespace bulbus::bench {

/// One row, measured in a process of its own so that peak memory is its own (or as many as ranks): this
/// program with `--child FILE` and these words. What ends without a row is a row with its reason.
json row_of_child(const std::vector<std::string>& words, int ranks = 1, int threads = 1);

/// In the child: rank 0 writes what `measure` makes of the words to the file. False in the parent.
bool ran_as_child(int& argc, char**& argv,
                  const std::function<json(const std::vector<std::string>& words)>& measure);

}  // namespace bulbus::bench
