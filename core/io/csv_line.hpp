#pragma once
#include <string>
#include <vector>

namespace bulbus::inline io {

/// Cells of a line of RFC 4180 without line ends inside of quotes, which no run writes.
std::vector<std::string> cells_of_line(const std::string& line);

}  // namespace bulbus::inline io
