#include "core/io/vtp.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/text_file.hpp"

namespace bulbus {
namespace {

std::string array_of(const std::string& type, const std::string& name, int components,
                     const std::string& numbers) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n",
      type, name, components, numbers);
}

std::string reals(const std::string& name, int components, std::span<const double> values) {
  return array_of("Float64", name, components, fmt::format("{:.9g}", fmt::join(values, " ")));
}

std::string polygons(std::span<const std::array<int, 3>> triangles) {
  std::string corners, ends;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    corners += fmt::format("{} ", fmt::join(triangles[t], " "));
    ends += fmt::format("{} ", 3 * (t + 1));
  }
  return "<Polys>\n" + array_of("Int64", "connectivity", 1, corners) + array_of("Int64", "offsets", 1, ends) +
         "</Polys>\n";
}

std::string file_of(const std::string& type, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<{0}>\n{1}</{0}>\n</VTKFile>\n",
      type, content);
}

}  // namespace

void write_vtp(const std::string& path, std::span<const double> points,
               std::span<const std::array<int, 3>> triangles, const std::vector<Field>& cell_fields) {
  std::string fields;
  for (const Field& f : cell_fields) fields += reals(f.name, f.components, f.values);
  write_whole(path, file_of("PolyData", fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n",
                                                    points.size() / 3, triangles.size()) +
                                            "<Points>\n" + reals("Points", 3, points) + "</Points>\n" +
                                            polygons(triangles) + "<CellData>\n" + fields +
                                            "</CellData>\n</Piece>\n"));
}

void Collection::add(const std::string& file, double time) {
  entries_ += fmt::format("<DataSet timestep=\"{:.12g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  write_whole(path_, file_of("Collection", entries_));
}

}  // namespace bulbus
