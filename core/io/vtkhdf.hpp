#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline io {

/// Values on the points or the cells of a piece, components innermost: value c of item i is values[i *
/// components + c]. Six components are xx, yy, zz, xy, yz, xz.
struct Field {
  std::string name;
  int components = 1;
  std::vector<double> values;
  std::string unit;     ///< empty: a plain number
  bool sparse = false;  ///< NaN where there is no value
};

/// A number of the whole data set, in VTK's field data: what a value of a field stands for. ParaView's
/// information panel shows both.
struct Label {
  std::string name;  ///< "region_lens"
  int value;
};

/// A name as files can hold it: a slash would end the name of an HDF5 dataset, XML has marks of its own.
std::string safe_name(std::string name);

/// What one rank saves. Hexahedra number the points of the piece from 0; every rank gives the same fields in
/// the same order. A piece may be empty.
struct Piece {
  std::span<const Point> points;
  std::span<const Hex> hexes;
  std::vector<Field> point_fields, cell_fields;
  std::vector<Label> labels;  ///< the same on every rank
};

/// Writes a VTKHDF file (UnstructuredGrid 1.0, which ParaView reads from 5.10 on under the name *.hdf), one
/// piece per rank: points in double, fields in single precision with an attribute `unit`. The file appears
/// under its name when it is complete. Collective. Throws std::runtime_error on every rank: before anything
/// is written if a value is not finite in single precision (but NaN in a sparse field), a field has the wrong
/// length or the ranks' fields differ; and if the file cannot be written.
void write_vtkhdf(const std::string& path, const Piece& piece, const Comm& comm);

}  // namespace bulbus::inline io
