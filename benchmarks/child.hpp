#pragma once
#include <functional>

#include "benchmarks/common.hpp"

namespace bulbus::bench {

/// One row, measured in a process of its own so that peak memory is its own: this program with `--child FILE`
/// and these words. What ends without a row is a row with its reason.
json row_of_child(const std::vector<std::string>& words);

/// In the child: writes what `measure` makes of the words to the file. False in the parent.
bool ran_as_child(int& argc, char**& argv,
                  const std::function<json(const std::vector<std::string>& words)>& measure);

}  // namespace bulbus::bench
