#pragma once
#include <string>
#include <vector>

namespace bulbus::inline io {

/// A whole dataset of numbers as doubles, row by row: such as `VTKHDF/PointData/displacement` of a saved
/// state. For tests and comparisons. Throws std::runtime_error. Not collective.
std::vector<double> read_dataset(const std::string& path, const std::string& dataset);

}  // namespace bulbus::inline io
