#include "app/report/solid_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/mesh/faces.hpp"

namespace bulbus::inline app {
namespace {

// New numbers in the order in which the old ones are asked for.
class Renumbering {
 public:
  explicit Renumbering(std::size_t count) : number_(count, -1) {}
  int operator()(int old) {
    if (number_[old] < 0) number_[old] = static_cast<int>(kept_.size()), kept_.push_back(old);
    return number_[old];
  }
  const std::vector<int>& kept() const { return kept_; }

 private:
  std::vector<int> number_, kept_;
};

std::vector<int> picked(const std::vector<int>& all, const std::vector<int>& which) {
  std::vector<int> some;
  for (int i : which) some.push_back(all[i]);
  return some;
}

// The same with the given faces alone, cells and nodes counted anew.
ShownSolid with_faces(const ShownSolid& solid, const std::vector<ShownFace>& faces) {
  Renumbering node(solid.nodes.size()), cell(solid.cells.size());
  ShownSolid shown;
  for (const ShownFace& face : faces) {
    Quad nodes;
    std::ranges::transform(face.nodes, nodes.begin(), std::ref(node));
    shown.faces.push_back({nodes, cell(face.cell), face.other});
  }
  shown.nodes = picked(solid.nodes, node.kept());
  shown.cells = picked(solid.cells, cell.kept());
  shown.regions = picked(solid.regions, cell.kept());
  return shown;
}

}  // namespace

void join_pieces(SavedMesh& mesh, std::span<const double> apart, std::size_t width) {
  if (mesh.pieces < 2) return;
  const auto less = [&](int a, int b) {
    if (mesh.points[a] != mesh.points[b]) return mesh.points[a] < mesh.points[b];
    return std::ranges::lexicographical_compare(apart.subspan(a * width, width),
                                                apart.subspan(b * width, width));
  };
  std::vector<int> order(mesh.points.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, less);
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !less(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  for (Hex& hex : mesh.hexes)
    for (int& node : hex) node = first[node];
}

ShownSolid whole_solid(const SavedMesh& mesh, std::span<const int> regions) {
  ShownSolid solid;
  solid.nodes.resize(mesh.points.size());
  std::iota(solid.nodes.begin(), solid.nodes.end(), 0);
  solid.cells.resize(mesh.hexes.size());
  std::iota(solid.cells.begin(), solid.cells.end(), 0);
  solid.regions.assign(regions.begin(), regions.end());
  solid.hexes = mesh.hexes;
  const FaceTable table(mesh.hexes);
  const auto add = [&](int face, int other) {
    solid.faces.push_back({face_nodes(mesh.hexes, face), face / 6, other});
  };
  for (int face = 0; face < 6 * static_cast<int>(mesh.hexes.size()); ++face) {
    const Quad nodes = face_nodes(mesh.hexes, face);
    const int first = table.first(nodes), here = regions[face / 6], there = regions[first / 6];
    if (first != face && there != here) add(first, here), add(face, there);
    if (first == face && table.count(nodes) == 1) add(face, -1);
  }
  return solid;
}

ShownSolid surface_of(const ShownSolid& solid) { return with_faces(solid, solid.faces); }

ShownSolid clustered(const ShownSolid& surface, std::span<const Point> points, double width) {
  std::map<std::array<long, 3>, int> cubes;
  std::vector<int> first(surface.nodes.size());
  for (std::size_t n = 0; n < first.size(); ++n) {
    std::array<long, 3> cube;
    std::ranges::transform(points[surface.nodes[n]], cube.begin(),
                           [&](double x) { return std::lround(x / width); });
    first[n] = cubes.try_emplace(cube, static_cast<int>(n)).first->second;
  }
  std::vector<ShownFace> faces;
  for (ShownFace face : surface.faces) {
    for (int& node : face.nodes) node = first[node];
    if (std::set<int>(face.nodes.begin(), face.nodes.end()).size() > 2) faces.push_back(face);
  }
  return with_faces(surface, faces);
}

}  // namespace bulbus::inline app
