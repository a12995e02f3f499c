#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/base/whole_file.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/repeated.hpp"
#include "core/mesh/vtk/vtk.hpp"
#include "core/mesh/vtk/vtk_grid.hpp"

namespace bulbus::inline mesh {
namespace {

constexpr int voxel = 11, hexahedron = 12;
constexpr std::size_t most_regions = 1000;

std::string kind_of(double type) {
  static const std::map<int, std::string> names{{1, "vertices"},
                                                {2, "poly-vertices"},
                                                {3, "lines"},
                                                {4, "poly-lines"},
                                                {5, "triangles"},
                                                {6, "triangle strips"},
                                                {7, "polygons"},
                                                {8, "pixels"},
                                                {9, "quads"},
                                                {10, "tetrahedra"},
                                                {13, "wedges"},
                                                {14, "pyramids"},
                                                {24, "tetrahedra of 10 nodes"},
                                                {25, "hexahedra of 20 nodes"},
                                                {29, "hexahedra of 27 nodes"},
                                                {42, "polyhedra"},
                                                {72, "Lagrange hexahedra"}};
  const auto at = names.find(type >= 0 && type < 1000 ? static_cast<int>(type) : -1);
  return at == names.end() ? fmt::format("of VTK type {:.0f}", type) : at->second;
}

class Builder {
 public:
  Builder(const VtkGrid& grid, const std::string& regions) : grid_(grid), regions_(regions) {}

  ReadMesh build() {
    refuse_others();
    add_points();
    add_cells();
    if (mesh_.hexes.empty()) fail("the mesh has no hexahedra", "write cells of type 12 (hexahedron)");
    add_regions();
    if (const auto pairs = repeated(mesh_.hexes); !pairs.empty())
      fail(fmt::format("cell {} has the same eight points as cell {}: {} of {} hexahedra stand twice",
                       pairs[0].second, pairs[0].first, pairs.size(), mesh_.hexes.size()),
           "write every cell once");
    number_ = drop_unused_points(mesh_);
    turn_inverted(mesh_);
    add_node_sets();
    add_surfaces();
    note_skipped();
    return {std::move(mesh_), std::move(notes_), {}};
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw input_error(grid_.path, 0, what, remedy);
  }

  void refuse_others() const {
    OtherCells others;
    long long hexes = 0;
    for (double type : grid_.types)
      if (type == hexahedron || type == voxel)
        ++hexes;
      else
        ++others[kind_of(type)];
    if (!others.empty())
      refuse_other_cells(
          grid_.path, 0, others, hexes,
          "keep only the hexahedra (in ParaView: Threshold on a cell array, or Extract Cells By Type)");
  }

  void add_points() {
    for (std::size_t i = 0; i + 2 < grid_.points.size(); i += 3) {
      mesh_.points.push_back({grid_.points[i], grid_.points[i + 1], grid_.points[i + 2]});
      for (double x : mesh_.points.back())
        if (!std::isfinite(x))
          fail(fmt::format("point {} has the coordinate {}", i / 3, x), "give the point a finite position");
    }
  }

  void add_cells() {
    const std::size_t cells = grid_.types.size();
    if (grid_.ends.size() != cells)
      fail(fmt::format("there are {} cell types and {} cells", cells, grid_.ends.size()),
           "write the file again");
    double begin = 0;
    for (std::size_t e = 0; e < cells; begin = grid_.ends[e++]) {
      if (grid_.ends[e] - begin != 8 || grid_.ends[e] > static_cast<double>(grid_.connectivity.size()))
        fail(fmt::format("cell {} is a hexahedron with {:.17g} points", e, grid_.ends[e] - begin),
             "write cells of type 12 with eight points");
      Hex h;
      for (int c = 0; c < 8; ++c) h[c] = point(e, grid_.connectivity[static_cast<std::size_t>(begin) + c]);
      if (grid_.types[e] == voxel) std::swap(h[2], h[3]), std::swap(h[6], h[7]);
      mesh_.hexes.push_back(h);
    }
  }

  int point(std::size_t cell, double index) const {
    if (!(index >= 0 && index < static_cast<double>(mesh_.points.size())) || index != std::floor(index))
      fail(fmt::format("cell {} has the point {:.17g}: the file has {}, counted from 0", cell, index,
                       mesh_.points.size()),
           "write all points of the mesh");
    return static_cast<int>(index);
  }

  // Of whole numbers, though the file may hold them as real ones.
  static bool could_be_regions(const VtkArray& a) {
    return a.components == 1 &&
           std::ranges::all_of(a.values, [](double v) { return v == std::floor(v) && std::abs(v) < 1e9; });
  }

  const VtkArray* array_of_regions() const {
    const auto at = std::ranges::find(grid_.cell_arrays, regions_, &VtkArray::name);
    if (at != grid_.cell_arrays.end()) return &*at;
    std::string names;
    bool whole = false;
    for (const VtkArray& a : grid_.cell_arrays) {
      names += (names.empty() ? "" : ", ") + printable(a.name, true);
      whole = whole || (a.whole && a.components == 1);
    }
    if (!whole && regions_ == "region") return nullptr;
    fail(fmt::format("there is no cell array '{}' that tells the regions", printable(regions_, true)),
         names.empty() ? "leave `regions` out: the mesh is one region then"
                       : "name the array that does, with `regions` beside `file`; it has: " + names);
  }

  void add_regions() {
    mesh_.region.assign(mesh_.hexes.size(), 0);
    const VtkArray* array = array_of_regions();
    if (!array) {
      mesh_.region_names = {"1"};
      return;
    }
    if (!could_be_regions(*array))
      fail("the cell array '" + printable(array->name, true) + "' does not hold one whole number per cell",
           "name one that does, with `regions` beside `file`");
    const std::set<double> numbers(array->values.begin(), array->values.end());
    if (numbers.size() > most_regions)
      fail(fmt::format("the cell array '{}' has {} different values: more than {} regions",
                       printable(array->name, true), numbers.size(), most_regions),
           "name the array that tells the regions, with `regions` beside `file`");
    std::map<double, int> index;
    for (double v : numbers) {
      index[v] = static_cast<int>(mesh_.region_names.size());
      mesh_.region_names.push_back(fmt::format("{}", static_cast<long long>(v)));
    }
    for (std::size_t e = 0; e < mesh_.hexes.size(); ++e) mesh_.region[e] = index[array->values[e]];
  }

  void add_node_sets() {
    for (const VtkArray& a : grid_.point_arrays) {
      std::vector<int> nodes;
      const bool is_set = a.whole && a.components == 1 &&
                          std::ranges::all_of(a.values, [](double v) { return v == 0 || v == 1; });
      for (std::size_t i = 0; is_set && i < a.values.size(); ++i)
        if (a.values[i] == 1 && number_[i] >= 0) nodes.push_back(number_[i]);
      if (nodes.empty())
        not_used_.push_back(a.name);
      else
        mesh_.node_sets[a.name] = std::move(nodes);
    }
  }

  void add_surfaces() {
    const FaceTable table(mesh_.hexes);
    for (int f = 0; f < 6 * static_cast<int>(mesh_.hexes.size()); ++f) {
      const Quad q = face_nodes(mesh_.hexes, f);
      if (table.count(q) == 1)
        add_outer(f, q);
      else
        add_between(table.first(q), f);
    }
  }

  const std::string& region_of(int face) const { return mesh_.region_names[mesh_.region[face / 6]]; }

  void add_outer(int face, const Quad& q) {
    mesh_.surfaces["boundary"].push_back(q);
    if (mesh_.region_names.size() > 1) mesh_.surfaces[region_of(face) + "/boundary"].push_back(q);
  }

  // Two faces in one place.
  void add_between(int first, int second) {
    const int a = mesh_.region[first / 6], b = mesh_.region[second / 6];
    if (a == b) return;
    const int face = a < b ? first : second, other = a < b ? second : first;
    mesh_.surfaces[region_of(face) + "/" + region_of(other)].push_back(face_nodes(mesh_.hexes, face));
  }

  void note_skipped() {
    for (const VtkArray& a : grid_.cell_arrays)
      if (a.name != regions_) not_used_.push_back(a.name);
    not_used_.insert(not_used_.end(), grid_.skipped.begin(), grid_.skipped.end());
    std::string names;
    for (std::size_t i = 0; i < not_used_.size() && i < 20; ++i)
      names += (i > 0 ? ", '" : "'") + printable(not_used_[i], true) + "'";
    if (not_used_.size() > 20) names += fmt::format(" and {} others", not_used_.size() - 20);
    if (!names.empty()) notes_.push_back("skipped in the mesh file: arrays " + names);
  }

  const VtkGrid& grid_;
  const std::string& regions_;
  Mesh mesh_;
  std::vector<std::string> notes_, not_used_;
  std::vector<int> number_;
};

}  // namespace

ReadMesh mesh_of(const VtkGrid& grid, const std::string& regions) { return Builder(grid, regions).build(); }

ReadMesh read_vtk(const std::string& path, const std::string& regions) {
  const std::string text = whole_file(path, "mesh file");
  const bool legacy = text.starts_with("# vtk DataFile");
  return mesh_of(legacy ? read_legacy_vtk(path, text) : read_vtu(path, text), regions);
}

}  // namespace bulbus::inline mesh
