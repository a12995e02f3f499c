#pragma once
#include <string>
#include <vector>

#include "core/mesh/imported.hpp"

namespace bulbus::inline mesh {

struct VtkArray {
  std::string name;
  int components = 1;
  bool whole = false;  ///< of an integer type
  std::vector<double> values;
};

/// What a file says, before it becomes a Mesh. Numbers are kept as doubles, which hold indices exactly.
struct VtkGrid {
  std::string path;
  std::vector<double> points;        ///< 3 per point
  std::vector<double> connectivity;  ///< points of all cells
  std::vector<double> ends;          ///< per cell, behind its last entry of connectivity
  std::vector<double> types;         ///< per cell
  std::vector<VtkArray> cell_arrays, point_arrays;
  std::vector<std::string> skipped;  ///< names of arrays that are not of numbers
};

/// `text`: the whole file.
VtkGrid read_vtu(const std::string& path, const std::string& text);
VtkGrid read_legacy_vtk(const std::string& path, const std::string& text);

/// The kinds of numbers in files.
enum class VtkType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
int size_of(VtkType type);
inline bool is_whole(VtkType type) { return type < VtkType::f32; }
/// The numbers in these bytes, which are of the other byte order if `swapped`.
std::vector<double> numbers_in(std::string_view bytes, VtkType type, bool swapped);

/// `regions`: name of the cell array.
ReadMesh mesh_of(const VtkGrid& grid, const std::string& regions);

}  // namespace bulbus::inline mesh
