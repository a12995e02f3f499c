#pragma once
#include <string>
#include <vector>

namespace bulbus::inline io {

/// A whole dataset of numbers as doubles, row by row: such as `VTKHDF/PointData/displacement` of a saved
/// state. Throws std::runtime_error. Not collective.
std::vector<double> read_dataset(const std::string& path, const std::string& dataset);

/// The names of what a group holds, in alphabetical order; none if the file has no such group. Throws
/// std::runtime_error if the file cannot be read. Not collective.
std::vector<std::string> names_in(const std::string& path, const std::string& group);

}  // namespace bulbus::inline io
