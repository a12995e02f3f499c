#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"

namespace bulbus::inline app {

/// The command: reads the arguments (without the program's name) and does what they say. Rank 0 alone prints.
/// Returns the exit status: 0 done, 1 not converged, 2 the input or the command line is wrong. Collective.
int command_line(std::vector<std::string> arguments, const Comm& comm, std::ostream& out, std::ostream& err);

}  // namespace bulbus::inline app
