#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/io/vtkhdf.hpp"

namespace bulbus::inline io {

/// What write_vtp has written.
struct SavedPolygons {
  std::vector<double> points;  ///< 3 per point, mm
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
  std::vector<Field> cell_fields;
  std::vector<Label> labels;
  /// The values of a field of that name; empty if there is none.
  const std::vector<double>& field(const std::string& name) const;
};

/// Throws std::runtime_error if the file is missing or damaged. Not collective.
SavedPolygons read_vtp(const std::string& path);

}  // namespace bulbus::inline io
