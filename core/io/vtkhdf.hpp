#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus {

/// Values on the points or the cells of a piece, components innermost: value c of item i is values[i *
/// components + c]. Six components are xx, yy, zz, xy, yz, xz.
struct Field {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

/// What one rank saves. Hexahedra number the points of the piece from 0; every rank gives the same fields in
/// the same order. A piece may be empty.
struct Piece {
  std::span<const Point> points;
  std::span<const Hex> hexes;
  std::vector<Field> point_fields, cell_fields;
};

/// Writes a VTKHDF file (UnstructuredGrid 1.0), one piece per rank: points in double, fields in single
/// precision. The file appears under its name when it is complete. Collective. Throws std::runtime_error on
/// every rank: before anything is written if a value is not finite in single precision, a field has the wrong
/// length or the ranks' fields differ; and if the file cannot be written.
void write_vtkhdf(const std::string& path, const Piece& piece, const Comm& comm);

}  // namespace bulbus
