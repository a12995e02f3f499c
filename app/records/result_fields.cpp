#include "app/records/result_fields.hpp"

#include <algorithm>
#include <array>

#include "app/records/contact_fields.hpp"
#include "app/records/nodal_average.hpp"
#include "app/records/strain_fields.hpp"

namespace bulbus::inline app {
namespace {

const std::array<std::string, 3> contact_kinds{"gap", "contact_pressure", "contact_status"};

Field displacement(const Snapshot& s) {
  Field f{"displacement", 3, s.state.x, "mm"};
  for (std::size_t i = 0; i < f.values.size(); ++i) f.values[i] -= s.problem.mesh().X[i];
  return f;
}

Field stress(Snapshot& s) {
  Field f{"stress", 6, {}, "MPa"};
  for (const CellStress& cell : s.stresses()) {
    const auto& c = cell.cauchy;
    for (double v : {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(0, 2)}) f.values.push_back(v);
  }
  return f;
}

Field mises(Snapshot& s) {
  Field f{"mises", 1, {}, "MPa"};
  for (const CellStress& cell : s.stresses()) f.values.push_back(cell.mises);
  return f;
}

Field pressure(const Snapshot& s) {
  Field f{"pressure", 1, s.state.lambda, "MPa"};
  for (double& v : f.values) v = -v;
  return f;
}

Field volume_ratio(Snapshot& s) {
  const auto V0 = s.problem.solid().reference_volumes();
  const auto& volume = s.residual().volume;  // collective: also on a rank without deformable hexahedra
  Field f{"J", 1, std::vector<double>(V0.size(), 1)};
  for (const SolidRegion& r : s.problem.solid().regions())
    for (int h = r.first; h < r.first + r.count; ++h) f.values[h] += volume[h] / V0[h];
  return f;
}

Field region(const Snapshot& s) {
  const LocalMesh& mesh = s.problem.mesh();
  Field f{"region", 1, std::vector<double>(mesh.hexes.size())};
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    std::fill_n(f.values.begin() + mesh.regions[r].first, mesh.regions[r].count, static_cast<double>(r));
  return f;
}

// A field of the cells and the same at the points.
void add_both(const Problem& problem, Field cells, Piece& piece) {
  piece.point_fields.push_back(
      {cells.name, cells.components, nodal_average(problem, cells.values, cells.components), cells.unit});
  piece.cell_fields.push_back(std::move(cells));
}

std::vector<Label> region_labels(const LocalMesh& mesh) {
  std::vector<Label> labels;
  for (const std::string& name : mesh.region_names)
    labels.push_back({safe_name("region_" + name), static_cast<int>(labels.size())});
  return labels;
}

}  // namespace

std::vector<Point> reference_points(const LocalMesh& mesh) {
  std::vector<Point> points(mesh.nodes());
  for (int n = 0; n < mesh.nodes(); ++n) points[n] = at(mesh.X, n);
  return points;
}

Piece piece_of(Snapshot& s, const Interactions& interactions, const std::vector<std::string>& wanted,
               const std::vector<Point>& points) {
  const auto is_wanted = [&](const std::string& name) { return std::ranges::count(wanted, name) > 0; };
  Piece piece{points, s.problem.mesh().hexes, {}, {}, region_labels(s.problem.mesh())};
  if (is_wanted("displacement")) piece.point_fields.push_back(displacement(s));
  if (is_wanted("stress")) add_both(s.problem, stress(s), piece);
  if (is_wanted("mises")) add_both(s.problem, mises(s), piece);
  if (is_wanted("pressure")) piece.cell_fields.push_back(pressure(s));
  if (is_wanted("pressure")) piece.cell_fields.push_back(volume_ratio(s));
  if (is_wanted("region")) piece.cell_fields.push_back(region(s));
  if (is_wanted("principal_stresses")) piece.cell_fields.push_back(principal_stresses(s));
  if (is_wanted("principal_stretches")) piece.cell_fields.push_back(principal_stretches(s));
  if (is_wanted("strain")) piece.cell_fields.push_back(green_strain(s));
  for (Field& f : contact_fields(interactions, s))
    if (std::ranges::any_of(contact_kinds, [&](const std::string& kind) {
          return is_wanted(kind) && (f.name == kind || f.name.starts_with(kind + "_"));
        }))
      piece.point_fields.push_back(std::move(f));
  return piece;
}

}  // namespace bulbus::inline app
