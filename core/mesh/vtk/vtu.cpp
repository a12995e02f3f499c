// VTK XML files of unstructured grids.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/mesh/vtk/vtk_grid.hpp"
#include "core/mesh/vtk/vtu_bytes.hpp"
#include "core/mesh/vtk/xml.hpp"

namespace bulbus::inline mesh {
namespace {

const char* const save_again = "write the file again (in ParaView: Save Data, .vtu)";

std::optional<VtkType> type_named(const std::string& name) {
  static const std::map<std::string, VtkType> types{
      {"Int8", VtkType::i8},     {"UInt8", VtkType::u8},   {"Int16", VtkType::i16}, {"UInt16", VtkType::u16},
      {"Int32", VtkType::i32},   {"UInt32", VtkType::u32}, {"Int64", VtkType::i64}, {"UInt64", VtkType::u64},
      {"Float32", VtkType::f32}, {"Float64", VtkType::f64}};
  const auto at = types.find(name);
  return at == types.end() ? std::nullopt : std::optional(at->second);
}

class VtuReader {
 public:
  explicit VtuReader(const std::string& path) { grid_.path = path; }

  VtkGrid read(const std::string& text) {
    const XmlElement root = parse_xml(grid_.path, text);
    if (root.name != "VTKFile" || root.attribute("type") != "UnstructuredGrid")
      fail(root,
           fmt::format("a <{}> of type '{}' is not read", printable(root.name),
                       printable(root.attribute("type"))),
           "give a <VTKFile type=\"UnstructuredGrid\">; join the pieces of a .pvtu file");
    take_format(root);
    const XmlElement& grid = part(root, "UnstructuredGrid");
    const XmlElement& piece = part(grid, "Piece");
    for (const XmlElement& other : grid.parts)
      if (other.name == "Piece" && &other != &piece)
        fail(other, "the grid has several pieces", "merge them (in ParaView: Merge Blocks or Clean to Grid)");
    take_piece(piece);
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const XmlElement& at, const std::string& what,
                         const std::string& remedy = save_again) const {
    throw input_error(grid_.path, at.line, what, remedy);
  }

  const XmlElement& part(const XmlElement& of, const char* name) const {
    const XmlElement* found = of.part(name);
    if (!found) fail(of, fmt::format("<{}> has no <{}>", printable(of.name), name));
    return *found;
  }

  void take_format(const XmlElement& root) {
    const bool big = root.attribute("byte_order") == "BigEndian";
    format_.swapped = big == (std::endian::native == std::endian::little);
    format_.wide = root.attribute("header_type") == "UInt64";
    const std::string& compressor = root.attribute("compressor");
    format_.compressed = !compressor.empty();
    if (format_.compressed && compressor != "vtkZLibDataCompressor")
      fail(root, "data of " + printable(compressor) + " are not read",
           "write the file with zlib or without compression");
    const XmlElement* appended = root.part("AppendedData");
    if (!appended) return;
    appended_base64_ = appended->attribute("encoding") == "base64";
    const std::size_t start = appended->text.find('_');
    if (start == std::string_view::npos) fail(*appended, "the appended data do not begin with '_'");
    appended_ = appended->text.substr(start + 1);
  }

  double count(const XmlElement& piece, const char* key) const {
    const std::string& text = piece.attribute(key);
    const auto value = parse_number<double>(text);
    if (!value || !(*value >= 0) || *value != std::floor(*value))
      fail(piece, fmt::format("{}=\"{}\" is no number of entries", key, printable(text)));
    return *value;
  }

  void take_piece(const XmlElement& piece) {
    const double points = count(piece, "NumberOfPoints"), cells = count(piece, "NumberOfCells");
    const XmlElement& place = part(part(piece, "Points"), "DataArray");
    grid_.points = needed(place, 3 * points).values;
    const XmlElement& of_cells = part(piece, "Cells");
    grid_.connectivity = needed(named(of_cells, "connectivity"), -1).values;
    grid_.ends = needed(named(of_cells, "offsets"), cells).values;
    grid_.types = needed(named(of_cells, "types"), cells).values;
    if (const XmlElement* data = piece.part("PointData")) take_arrays(*data, points, grid_.point_arrays);
    if (const XmlElement* data = piece.part("CellData")) take_arrays(*data, cells, grid_.cell_arrays);
  }

  const XmlElement& named(const XmlElement& of, const char* name) const {
    for (const XmlElement& array : of.parts)
      if (array.attribute("Name") == name) return array;
    fail(of, fmt::format("<{}> has no array '{}'", printable(of.name), name));
  }

  void take_arrays(const XmlElement& data, double tuples, std::vector<VtkArray>& arrays) {
    for (const XmlElement& e : data.parts)
      if (e.name == "DataArray" && type_named(e.attribute("type")))
        arrays.push_back(needed(e, tuples, true));
      else
        grid_.skipped.push_back(e.attribute("Name"));
  }

  // `entries`: −1 if it is not known before; `tuples`: it counts groups of components.
  VtkArray needed(const XmlElement& e, double entries, bool tuples = false) const {
    const auto type = type_named(e.attribute("type"));
    if (!type)
      fail(e, fmt::format("an array has the type '{}'", printable(e.attribute("type"))),
           "write Int32, Int64, Float32 or Float64");
    VtkArray array{e.attribute("Name"), 1, is_whole(*type), {}};
    if (!e.attribute("NumberOfComponents").empty()) {
      const double components = count(e, "NumberOfComponents");
      if (components < 1 || components > 1000) fail(e, "an array has no or too many components");
      array.components = static_cast<int>(components);
    }
    if (tuples) entries *= array.components;
    const std::string& format = e.attribute("format");
    if (format == "ascii" || format.empty())
      array.values = words(e);
    else
      array.values = binary(e, format, *type);
    if (entries >= 0 && static_cast<double>(array.values.size()) != entries)
      fail(e,
           fmt::format("the array '{}' has {} numbers instead of {:.0f}", printable(array.name, true),
                       array.values.size(), entries),
           "write the file again; it may have been cut off");
    return array;
  }

  std::vector<double> words(const XmlElement& e) const {
    std::vector<double> values;
    const std::string_view blanks = " \t\r\n", text = e.text;
    for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;) {
      const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
      double value = 0;
      const auto [stop, failure] = std::from_chars(text.data() + at, text.data() + end, value);
      if (failure != std::errc() || stop != text.data() + end)
        fail(e, fmt::format("'{}' in the array '{}' is no number", printable(text.substr(at, end - at)),
                            printable(e.attribute("Name"), true)));
      values.push_back(value);
      at = text.find_first_not_of(blanks, end);
    }
    return values;
  }

  std::vector<double> binary(const XmlElement& e, const std::string& format, VtkType type) const {
    const bool is_appended = format == "appended";
    if (!is_appended && format != "binary")
      fail(e, fmt::format("the format '{}' is not read", printable(format)),
           "write ascii, binary or appended data");
    std::string_view stream = e.text;
    if (is_appended) {
      const double offset = count(e, "offset");
      if (offset > static_cast<double>(appended_.size()))
        fail(e,
             fmt::format("offset {:.0f} lies behind the {} bytes of appended data", offset, appended_.size()),
             "write the file again; it may have been cut off");
      stream = appended_.substr(static_cast<std::size_t>(offset));
    }
    try {
      const std::string bytes = array_bytes(VtuBytes(stream, is_appended ? appended_base64_ : true), format_);
      if (bytes.size() % size_of(type) != 0) throw std::length_error("the data end within a number");
      return numbers_in(bytes, type, format_.swapped);
    } catch (const std::length_error& fault) {
      fail(e,
           fmt::format("the array '{}' cannot be read: {}", printable(e.attribute("Name"), true),
                       fault.what()),
           "write the file again; it may have been cut off");
    }
  }

  VtkGrid grid_;
  VtuFormat format_;
  std::string_view appended_;
  bool appended_base64_ = false;
};

}  // namespace

VtkGrid read_vtu(const std::string& path, const std::string& text) { return VtuReader(path).read(text); }

}  // namespace bulbus::inline mesh
