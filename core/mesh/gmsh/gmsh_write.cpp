#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus::inline mesh {
namespace {

/// A physical group; in the file it is one entity of the same tag.
struct Group {
  int dimension, tag;
  std::string name;
  std::vector<int> nodes;  ///< of all its elements, in a row

  int type() const { return std::array{15, 1, 3, 5}[dimension]; }
  int width() const { return std::array{1, 2, 4, 8}[dimension]; }
  std::size_t count() const { return nodes.size() / width(); }
};

/// What is to be written: the mesh's nodes, then the ends of bars that are none of them.
struct Content {
  std::vector<Point> points;
  std::vector<Group> groups;
  std::size_t elements = 0;

  explicit Content(const Mesh& mesh) : points(mesh.points) {
    for (const auto& [name, nodes] : mesh.node_sets)
      if (!nodes.empty()) group(0, name).nodes = nodes;
    for (const auto& [name, bars] : mesh.bars)
      for (const Bar& bar : bars) {
        std::vector<int>& nodes =
            group(1, bar.share == 1 ? name : fmt::format("{} share={}", name, bar.share)).nodes;
        nodes.push_back(end(mesh, bar.a));
        nodes.push_back(end(mesh, bar.b));
      }
    for (const auto& [name, quads] : mesh.surfaces)
      for (const Quad& q : quads) append(group(2, name), q);
    for (const std::string& name : mesh.region_names) group(3, name);  // tags in the order of the regions
    for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
      append(group(3, mesh.region_names[mesh.region[e]]), mesh.hexes[e]);
    std::erase_if(groups, [](const Group& g) { return g.nodes.empty(); });
    for (const Group& g : groups) elements += g.count();
  }

 private:
  Group& group(int dimension, const std::string& name) {
    int last = 0;
    for (Group& g : groups) {
      if (g.dimension == dimension && g.name == name) return g;
      if (g.dimension == dimension) last = g.tag;
    }
    return groups.emplace_back(Group{dimension, last + 1, name, {}});
  }
  template <class Nodes>
  static void append(Group& g, const Nodes& nodes) {
    g.nodes.insert(g.nodes.end(), nodes.begin(), nodes.end());
  }
  int end(const Mesh& mesh, const EmbeddedPoint& e) {
    if (const int node = sole_node(e); node >= 0) return node;
    points.push_back(position(mesh, e));
    return static_cast<int>(points.size()) - 1;
  }
};

/// Writes under a temporary name: the file takes its own when it is whole.
class Writer {
 public:
  Writer(const std::string& path, bool binary)
      : path_(path),
        written_(is_special(path) ? path : path + ".tmp"),
        out_(written_, std::ios::binary),
        binary_(binary) {
    if (!out_) fail();
  }
  template <class... T>
  void text(fmt::format_string<T...> pattern, T&&... values) {
    out_ << fmt::format(pattern, std::forward<T>(values)...);
  }
  /// A number as T: bytes, or text and a blank.
  template <class T>
  void put(T value) {
    if (binary_)
      out_.write(reinterpret_cast<const char*>(&value), sizeof value);
    else
      out_ << fmt::format("{} ", value);
  }
  void put(const Point& p) {
    for (double x : p) put(x);
  }
  void end_line() {
    if (!binary_) out_ << '\n';
  }
  void close() {
    out_.close();
    if (!out_ || std::rename(written_.c_str(), path_.c_str()) != 0) fail();
  }

 private:
  // A pipe or a device.
  static bool is_special(const std::string& path) {
    return std::filesystem::exists(path) && !std::filesystem::is_regular_file(path);
  }
  [[noreturn]] void fail() const {
    if (written_ != path_) std::remove(written_.c_str());
    throw input_error(path_, 0, "cannot write the mesh", "check the folder and its free space");
  }
  std::string path_, written_;
  std::ofstream out_;
  bool binary_;
};

void write_header(Writer& out, const Content& content, const GmshFormat& format) {
  out.text("$MeshFormat\n{} {} 8\n", format.version4 ? "4.1" : "2.2", format.binary ? 1 : 0);
  if (format.binary) {
    out.put(1);
    out.text("\n");
  }
  out.text("$EndMeshFormat\n$PhysicalNames\n{}\n", content.groups.size());
  for (const Group& g : content.groups) out.text("{} {} \"{}\"\n", g.dimension, g.tag, g.name);
  out.text("$EndPhysicalNames\n");
}

void write2(Writer& out, const Content& content, bool binary) {
  out.text("$Nodes\n{}\n", content.points.size());
  for (std::size_t k = 0; k < content.points.size(); ++k) {
    out.put(static_cast<int>(k + 1));
    out.put(content.points[k]);
    out.end_line();
  }
  out.text("{}$EndNodes\n$Elements\n{}\n", binary ? "\n" : "", content.elements);
  int number = 0;
  for (const Group& g : content.groups) {
    const int count = static_cast<int>(g.count());
    if (binary)
      for (int value : {g.type(), count, 2}) out.put(value);
    for (int e = 0; e < count; ++e) {
      out.put(++number);
      if (!binary)
        for (int value : {g.type(), 2}) out.put(value);
      for (int value : {g.tag, g.tag}) out.put(value);
      for (int c = 0; c < g.width(); ++c) out.put(g.nodes[e * g.width() + c] + 1);
      out.end_line();
    }
  }
  out.text("{}$EndElements\n", binary ? "\n" : "");
}

void write_entities(Writer& out, const Content& content, bool binary) {
  Point low = content.points.at(0), high = low;
  for (const Point& p : content.points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  out.text("$Entities\n");
  for (int d = 0; d < 4; ++d)
    out.put<std::size_t>(std::count_if(content.groups.begin(), content.groups.end(),
                                       [d](const Group& g) { return g.dimension == d; }));
  out.end_line();
  for (int d = 0; d < 4; ++d)
    for (const Group& g : content.groups) {
      if (g.dimension != d) continue;
      out.put(g.tag);
      out.put(d == 0 ? content.points[g.nodes[0]] : low);
      if (d > 0) out.put(high);
      out.put<std::size_t>(1);
      out.put(g.tag);
      if (d > 0) out.put<std::size_t>(0);  // bounding entities: not told
      out.end_line();
    }
  out.text("{}$EndEntities\n", binary ? "\n" : "");
}

void write4(Writer& out, const Content& content, bool binary) {
  write_entities(out, content, binary);
  const std::size_t nodes = content.points.size();
  const auto counts = [&](std::size_t blocks, std::size_t all) {
    for (std::size_t value : {blocks, all, std::size_t{1}, all}) out.put(value);
    out.end_line();
  };
  out.text("$Nodes\n");
  counts(1, nodes);
  for (int value : {3, content.groups.back().tag, 0}) out.put(value);
  out.put(nodes);
  out.end_line();
  for (std::size_t k = 1; k <= nodes; ++k) {
    out.put(k);
    out.end_line();
  }
  for (const Point& p : content.points) {
    out.put(p);
    out.end_line();
  }
  out.text("{}$EndNodes\n$Elements\n", binary ? "\n" : "");
  counts(content.groups.size(), content.elements);
  std::size_t number = 0;
  for (const Group& g : content.groups) {
    for (int value : {g.dimension, g.tag, g.type()}) out.put(value);
    out.put(g.count());
    out.end_line();
    for (std::size_t e = 0; e < g.count(); ++e) {
      out.put(++number);
      for (int c = 0; c < g.width(); ++c) out.put(static_cast<std::size_t>(g.nodes[e * g.width() + c] + 1));
      out.end_line();
    }
  }
  out.text("{}$EndElements\n", binary ? "\n" : "");
}

}  // namespace

void write_gmsh(const Mesh& mesh, const std::string& path, const GmshFormat& format) {
  const Content content(mesh);
  Writer out(path, format.binary);
  write_header(out, content, format);
  if (format.version4)
    write4(out, content, format.binary);
  else
    write2(out, content, format.binary);
  out.close();
}

}  // namespace bulbus::inline mesh
