#pragma once
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/base64.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::test {

/// An Abaqus input file of a mesh without bars: regions, node sets and surfaces, and a little of a model.
inline std::string abaqus_text(const Mesh& mesh) {
  std::string text = "*HEADING\n** written by a test\n*NODE, NSET=ALL\n";
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    text +=
        fmt::format("{}, {}, {}, {}\n", 10 * n + 1, mesh.points[n][0], mesh.points[n][1], mesh.points[n][2]);
  text += "*ELEMENT, TYPE=C3D8R\n";
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) {
    text += fmt::format("{}", 3 * e + 1);
    for (int n : mesh.hexes[e]) text += fmt::format(", {}", 10 * n + 1);
    text += '\n';
  }
  for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
    text += "*ELSET, ELSET=" + mesh.region_names[r] + "\n";
    for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
      if (mesh.region[e] == static_cast<int>(r)) text += fmt::format("{},\n", 3 * e + 1);
  }
  for (const std::string& name : mesh.region_names)
    text += "*SOLID SECTION, ELSET=" + name + ", MATERIAL=m\n";
  for (const auto& [name, nodes] : mesh.node_sets) {
    text += "*NSET, NSET=" + name + "\n";
    for (int n : nodes) text += fmt::format("{}\n", 10 * n + 1);
  }
  const FaceTable faces(mesh.hexes);
  for (const auto& [name, quads] : mesh.surfaces) {
    text += "*SURFACE, TYPE=ELEMENT, NAME=" + name + "\n";
    for (const Quad& q : quads)
      text += fmt::format("{}, S{}\n", 3 * (faces.first(q) / 6) + 1, faces.first(q) % 6 + 1);
  }
  return text + "*MATERIAL, NAME=m\n*ELASTIC\n1., .3\n*STEP\n*STATIC\n*END STEP\n";
}

/// How the arrays of a VTU file are kept.
struct VtuStyle {
  bool binary = false, appended = false, compressed = false, wide = false;
};

inline std::string base64(const std::string& bytes) {
  return bulbus::base64(std::as_bytes(std::span(bytes)));
}

/// A VTU file of a mesh: regions as the cell array `region` from 1 on, node sets as point arrays of 0 and 1.
class VtuText {
 public:
  VtuText(const Mesh& mesh, VtuStyle style) : style_(style) {
    std::vector<double> points;
    for (const Point& p : mesh.points) points.insert(points.end(), p.begin(), p.end());
    std::vector<std::int64_t> nodes, ends;
    for (const Hex& h : mesh.hexes) {
      nodes.insert(nodes.end(), h.begin(), h.end());
      ends.push_back(static_cast<std::int64_t>(nodes.size()));
    }
    std::vector<std::int32_t> regions;
    for (int r : mesh.region) regions.push_back(r + 1);
    body_ = fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n",
                        mesh.points.size(), mesh.hexes.size());
    for (const auto& [name, set] : mesh.node_sets) {
      std::vector<std::int8_t> marks(mesh.points.size());
      for (int n : set) marks[n] = 1;
      add(name, "Int8", marks);
    }
    body_ += "</PointData>\n<CellData>\n";
    add("region", "Int32", regions);
    body_ += "</CellData>\n<Points>\n";
    add("Points", "Float64", points, 3);
    body_ += "</Points>\n<Cells>\n";
    add("connectivity", "Int64", nodes);
    add("offsets", "Int64", ends);
    add("types", "UInt8", std::vector<std::uint8_t>(mesh.hexes.size(), 12));
    body_ += "</Cells>\n</Piece>\n";
  }

  std::string text() const {
    return std::string(
               "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
               "byte_order=\"LittleEndian\" header_type=\"") +
           (style_.wide ? "UInt64" : "UInt32") + "\"" +
           (style_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<UnstructuredGrid>\n" +
           body_ + "</UnstructuredGrid>\n" +
           (style_.appended ? "<AppendedData encoding=\"raw\">\n_" + appended_ + "\n</AppendedData>\n" : "") +
           "</VTKFile>\n";
  }

 private:
  template <class T>
  void add(const std::string& name, const char* type, const std::vector<T>& values, int components = 1) {
    body_ +=
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ", type, name, components);
    if (!style_.binary) {
      body_ += "format=\"ascii\">\n";
      for (const T& v : values) body_ += fmt::format("{} ", v);
      body_ += "\n</DataArray>\n";
      return;
    }
    const std::string raw(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    const auto [sizes, data] = packed(raw);
    if (style_.appended) {
      body_ += fmt::format("format=\"appended\" offset=\"{}\"/>\n", appended_.size());
      appended_ += sizes + data;
    } else {  // sizes and data are one base64 text, unless they are compressed
      body_ += "format=\"binary\">\n" +
               (style_.compressed ? base64(sizes) + base64(data) : base64(sizes + data)) + "\n</DataArray>\n";
    }
  }

  std::string size(std::uint64_t n) const {
    return {reinterpret_cast<const char*>(&n), style_.wide ? 8u : 4u};  // little-endian
  }

  // In blocks of 100 bytes.
  std::pair<std::string, std::string> packed(const std::string& raw) const {
    if (!style_.compressed) return {size(raw.size()), raw};
    constexpr std::size_t block = 100;
    std::string sizes = size((raw.size() + block - 1) / block) + size(block) + size(raw.size() % block), data;
    for (std::size_t at = 0; at < raw.size(); at += block) {
      const std::string part = raw.substr(at, block);
      uLongf length = compressBound(part.size());
      std::string small(length, '\0');
      compress(reinterpret_cast<Bytef*>(small.data()), &length, reinterpret_cast<const Bytef*>(part.data()),
               part.size());
      sizes += size(length);
      data += small.substr(0, length);
    }
    return {sizes, data};
  }

  VtuStyle style_;
  std::string body_, appended_;
};

inline std::string vtu_text(const Mesh& mesh, VtuStyle style = {}) { return VtuText(mesh, style).text(); }

/// A legacy VTK file of the same, in ASCII or big-endian binary.
inline std::string legacy_vtk_text(const Mesh& mesh, bool binary = false) {
  std::string text = std::string("# vtk DataFile Version 3.0\ntest\n") + (binary ? "BINARY" : "ASCII") +
                     "\nDATASET UNSTRUCTURED_GRID\n";
  const auto put = [&]<class T>(T value) {
    if (!binary) return void(text += fmt::format("{} ", value));
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    std::ranges::reverse(bytes);
    text += bytes;
  };
  text += fmt::format("POINTS {} double\n", mesh.points.size());
  for (const Point& p : mesh.points)
    for (double x : p) put(x);
  text += fmt::format("\nCELLS {} {}\n", mesh.hexes.size(), 9 * mesh.hexes.size());
  for (const Hex& h : mesh.hexes) {
    put(std::int32_t{8});
    for (std::int32_t n : h) put(n);
  }
  text += fmt::format("\nCELL_TYPES {}\n", mesh.hexes.size());
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) put(std::int32_t{12});
  text += fmt::format("\nCELL_DATA {}\nSCALARS region int 1\nLOOKUP_TABLE default\n", mesh.hexes.size());
  for (std::int32_t r : mesh.region) put(r + 1);
  text += fmt::format("\nPOINT_DATA {}\nFIELD FieldData {}\n", mesh.points.size(), mesh.node_sets.size());
  for (const auto& [name, set] : mesh.node_sets) {
    text += fmt::format("{} 1 {} int\n", name, mesh.points.size());
    std::vector<std::int32_t> marks(mesh.points.size());
    for (int n : set) marks[n] = 1;
    for (std::int32_t m : marks) put(m);
    text += '\n';
  }
  return text;
}

}  // namespace bulbus::test
