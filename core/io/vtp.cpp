#include "core/io/vtp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "core/base/base64.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline io {
namespace {

// The number of bytes as UInt64, then the bytes: one base64 text.
template <class T>
std::string inline_binary(const std::vector<T>& values) {
  std::vector<std::byte> bytes(sizeof(std::uint64_t) + sizeof(T) * values.size());
  const std::uint64_t count = sizeof(T) * values.size();
  std::copy_n(reinterpret_cast<const std::byte*>(&count), sizeof count, bytes.begin());
  std::copy_n(reinterpret_cast<const std::byte*>(values.data()), count, bytes.begin() + sizeof count);
  return base64(bytes);
}

std::string reals(const std::string& name, int components, std::span<const double> values) {
  return fmt::format(
      "<DataArray type=\"Float32\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
      name, components, inline_binary(std::vector<float>(values.begin(), values.end())));
}

std::string integers(const std::string& name, const std::vector<std::int32_t>& values) {
  return fmt::format("<DataArray type=\"Int32\" Name=\"{}\" format=\"binary\">{}</DataArray>\n", name,
                     inline_binary(values));
}

template <std::size_t corners>
std::string cells(const std::string& kind, std::span<const std::array<int, corners>> all) {
  std::vector<std::int32_t> connectivity, offsets;
  for (const auto& cell : all) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  return fmt::format("<{0}>\n{1}{2}</{0}>\n", kind, integers("connectivity", connectivity),
                     integers("offsets", offsets));
}

std::string label(const Label& l) {
  return fmt::format(
      "<DataArray type=\"Int32\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n", l.name,
      l.value);
}

std::string file_of(const std::string& type, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<{0}>\n{1}</{0}>\n</VTKFile>\n",
      type, content);
}

}  // namespace

void write_vtp(const std::string& path, const Polygons& p) {
  std::string labels, fields;
  for (const Label& l : p.labels) labels += label(l);
  for (const Field& f : p.cell_fields) fields += reals(f.name, f.components, f.values);
  write_whole(
      path,
      file_of("PolyData",
              "<FieldData>\n" + labels + "</FieldData>\n" +
                  fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\" NumberOfPolys=\"{}\">\n",
                              p.points.size() / 3, p.lines.size(), p.triangles.size()) +
                  "<Points>\n" + reals("Points", 3, p.points) + "</Points>\n" + cells("Lines", p.lines) +
                  cells("Polys", p.triangles) + "<CellData>\n" + fields + "</CellData>\n</Piece>\n"));
}

void Collection::add(const std::string& file, double time) {
  entries_ += fmt::format("<DataSet timestep=\"{:.12g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  write_whole(path_, file_of("Collection", entries_));
}

}  // namespace bulbus::inline io
