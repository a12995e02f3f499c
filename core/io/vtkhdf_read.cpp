#include "core/io/vtkhdf_read.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/io/hdf5_read.hpp"

namespace bulbus::inline io {
namespace {

using Numbers = std::vector<double>;

std::vector<Point> points_of(const Numbers& numbers) {
  std::vector<Point> points(numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(numbers.begin() + static_cast<long>(3 * i), 3, points[i].begin());
  return points;
}

// Hexahedra count the points of their piece from 0.
std::vector<Hex> hexes_of(const Numbers& connectivity, const Numbers& points, const Numbers& cells) {
  std::vector<Hex> hexes;
  hexes.reserve(connectivity.size() / 8);
  double first = 0, last = 0;
  for (std::size_t piece = 0; piece < std::min(points.size(), cells.size()); ++piece) {
    last += points[piece];
    for (double c = 0; c < cells[piece]; ++c) {
      Hex& hex = hexes.emplace_back();
      for (int i = 0; i < 8; ++i) {
        const double node = first + connectivity.at(8 * (hexes.size() - 1) + i);
        if (!(node >= first && node < last)) throw std::out_of_range("a node");
        hex[i] = static_cast<int>(node);
      }
    }
    first = last;
  }
  return hexes;
}

std::vector<Label> labels_of(const std::string& path) {
  std::vector<Label> labels;
  for (const std::string& name : names_in(path, "VTKHDF/FieldData"))
    if (const Numbers value = read_dataset(path, "VTKHDF/FieldData/" + name); !value.empty())
      labels.push_back({name, static_cast<int>(value[0])});
  return labels;
}

}  // namespace

SavedMesh read_vtkhdf_mesh(const std::string& path) {
  const auto read = [&](const char* name) { return read_dataset(path, std::string("VTKHDF/") + name); };
  const Numbers pieces = read("NumberOfPoints");
  SavedMesh mesh{points_of(read("Points")), {}, labels_of(path), static_cast<int>(pieces.size())};
  try {
    mesh.hexes = hexes_of(read("Connectivity"), pieces, read("NumberOfCells"));
  } catch (const std::out_of_range&) {
    throw std::runtime_error(path + ": its cells name points that it does not have");
  }
  double points = 0;
  for (double count : pieces) points += count;
  if (points != static_cast<double>(mesh.points.size()))
    throw std::runtime_error(path + ": its pieces have other points than it has");
  return mesh;
}

}  // namespace bulbus::inline io
