#include "core/io/vtp_read.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/base/parse_number.hpp"
#include "core/base/whole_file.hpp"
#include "core/mesh/vtk/vtk_grid.hpp"
#include "core/mesh/vtk/vtu_bytes.hpp"
#include "core/mesh/vtk/xml.hpp"

namespace bulbus::inline io {
namespace {

constexpr VtuFormat saved_format{.wide = true};

std::vector<double> numbers_of(const XmlElement& array) {
  const VtkType type = array.attribute("type") == "Float32" ? VtkType::f32 : VtkType::i32;
  return numbers_in(array_bytes(VtuBytes(array.text, true), saved_format), type, false);
}

const XmlElement& part(const XmlElement& of, const char* name) {
  const XmlElement* found = of.part(name);
  if (!found) throw std::length_error(std::string("it has no <") + name + ">");
  return *found;
}

template <std::size_t corners>
std::vector<std::array<int, corners>> cells_of(const XmlElement& kind, std::size_t points) {
  for (const XmlElement& array : kind.parts) {
    if (array.attribute("Name") != "connectivity") continue;
    const std::vector<double> numbers = numbers_of(array);
    std::vector<std::array<int, corners>> cells(numbers.size() / corners);
    for (std::size_t i = 0; i < corners * cells.size(); ++i) {
      if (!(numbers[i] >= 0 && numbers[i] < static_cast<double>(points)))
        throw std::length_error("a cell names a point that it does not have");
      cells[i / corners][i % corners] = static_cast<int>(numbers[i]);
    }
    return cells;
  }
  throw std::length_error("it has no connectivity");
}

SavedPolygons polygons_of(const XmlElement& root) {
  const XmlElement &data = part(root, "PolyData"), &piece = part(data, "Piece"),
                   &points = part(piece, "Points");
  SavedPolygons saved;
  if (points.parts.empty()) throw std::length_error("it has no points");
  saved.points = numbers_of(points.parts[0]);
  saved.triangles = cells_of<3>(part(piece, "Polys"), saved.points.size() / 3);
  saved.lines = cells_of<2>(part(piece, "Lines"), saved.points.size() / 3);
  for (const XmlElement& array : part(piece, "CellData").parts)
    saved.cell_fields.push_back({array.attribute("Name"), 1, numbers_of(array)});
  for (const XmlElement& array : part(data, "FieldData").parts)
    saved.labels.push_back(
        {array.attribute("Name"), parse_number<int>(std::string(array.text)).value_or(-1)});
  return saved;
}

}  // namespace

const std::vector<double>& SavedPolygons::field(const std::string& name) const {
  static const std::vector<double> none;
  const auto found = std::ranges::find(cell_fields, name, &Field::name);
  return found == cell_fields.end() ? none : found->values;
}

SavedPolygons read_vtp(const std::string& path) {
  const std::string text = whole_file(path, "file of surfaces or lines");
  try {
    return polygons_of(parse_xml(path, text));
  } catch (const std::length_error& fault) {
    throw std::runtime_error(path + ": cannot be read: " + fault.what());
  }
}

}  // namespace bulbus::inline io
