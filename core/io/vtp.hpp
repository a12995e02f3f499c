#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/io/vtkhdf.hpp"

namespace bulbus::inline io {

/// Triangles or lines (not both) with fields of them: 3 numbers per point.
struct Polygons {
  std::span<const double> points;
  std::span<const std::array<int, 3>> triangles;
  std::span<const std::array<int, 2>> lines;
  std::vector<Field> cell_fields;
  std::vector<Label> labels;
};

/// Writes a VTK XML PolyData file: arrays in single precision, base64. Whole or not at all. Throws
/// std::runtime_error. Not collective.
void write_vtp(const std::string& path, const Polygons& polygons);

/// The index of saved VTK XML files that ParaView opens: `bodies.pvd`. Not collective: for one rank.
class Collection {
 public:
  explicit Collection(std::string path) : path_(std::move(path)) {}
  /// Adds a state and rewrites the index whole; `file` is relative to the index. Throws std::runtime_error.
  void add(const std::string& file, double time);

 private:
  std::string path_, entries_;
};

}  // namespace bulbus::inline io
