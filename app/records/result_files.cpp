#include "app/records/result_files.hpp"

#include <algorithm>

#include "app/records/contact_fields.hpp"
#include "app/records/nodal_average.hpp"
#include "core/io/output.hpp"
#include "core/io/vtkhdf.hpp"

namespace bulbus {
namespace {

std::vector<Point> reference_points(const LocalMesh& mesh) {
  std::vector<Point> points(mesh.nodes());
  for (int n = 0; n < mesh.nodes(); ++n) points[n] = at(mesh.X, n);
  return points;
}

Field displacement(const Snapshot& s) {
  Field f{"displacement", 3, s.state.x};
  for (std::size_t i = 0; i < f.values.size(); ++i) f.values[i] -= s.problem.mesh().X[i];
  return f;
}

Field stress(Snapshot& s) {
  Field f{"stress", 6, {}};
  for (const CellStress& cell : s.stresses()) {
    const auto& c = cell.cauchy;
    for (double v : {c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(1, 2), c(0, 2)}) f.values.push_back(v);
  }
  return f;
}

Field mises(Snapshot& s) {
  Field f{"mises", 1, {}};
  for (const CellStress& cell : s.stresses()) f.values.push_back(cell.mises);
  return f;
}

Field pressure(const Snapshot& s) {
  Field f{"pressure", 1, s.state.lambda};
  for (double& v : f.values) v = -v;
  return f;
}

Field volume_ratio(Snapshot& s) {
  const auto V0 = s.problem.solid().reference_volumes();
  Field f{"J", 1, std::vector<double>(V0.size(), 1)};
  for (const SolidRegion& r : s.problem.solid().regions())
    for (int h = r.first; h < r.first + r.count; ++h) f.values[h] += s.residual().volume[h] / V0[h];
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
      {cells.name, cells.components, nodal_average(problem, cells.values, cells.components)});
  piece.cell_fields.push_back(std::move(cells));
}

Piece piece_of(Snapshot& s, const Interactions& interactions, const OutputSettings& settings,
               const std::vector<Point>& points) {
  const auto wanted = [&](const std::string& name) { return std::ranges::count(settings.fields, name) > 0; };
  Piece piece{points, s.problem.mesh().hexes, {}, {}};
  if (wanted("displacement")) piece.point_fields.push_back(displacement(s));
  if (wanted("stress")) add_both(s.problem, stress(s), piece);
  if (wanted("mises")) add_both(s.problem, mises(s), piece);
  if (wanted("pressure")) piece.cell_fields.push_back(pressure(s));
  if (wanted("pressure")) piece.cell_fields.push_back(volume_ratio(s));
  if (wanted("region")) piece.cell_fields.push_back(region(s));
  for (Field& f : contact_fields(interactions, s))
    if (wanted(f.name)) piece.point_fields.push_back(std::move(f));
  return piece;
}

}  // namespace

ResultFiles::ResultFiles(const OutputSettings& settings, std::shared_ptr<const Interactions> interactions,
                         ResultsFolder& folder)
    : settings_(settings),
      interactions_(interactions),
      folder_(folder),
      series_(folder.path() + "/" + series_file),
      bodies_(interactions, folder.path()) {}

void ResultFiles::increment_done(int number, double time, Snapshot& snapshot) {
  last_ = number;
  time_ = time;
  if (number % settings_.every == 0) save(snapshot);
}

void ResultFiles::finish(Snapshot& snapshot) {
  if (saved_.empty() || saved_[saved_.size() - 2] != last_) save(snapshot);
}

void ResultFiles::save(Snapshot& s) {
  if (!settings_.vtk) return;
  const std::string file = result_file(last_);
  claim_indices();
  folder_.claim(interactions_->bodies().empty() ? std::vector{file} : std::vector{file, bodies_file(last_)});
  const auto points = reference_points(s.problem.mesh());
  write_vtkhdf(folder_.path() + "/" + file, piece_of(s, *interactions_, settings_, points), s.problem.comm());
  write_together(s.problem.comm(), [&] {
    if (s.problem.comm().rank() != 0) return;
    bodies_.save(last_);
    list(last_, time_);
  });
  saved_.insert(saved_.end(), {static_cast<double>(last_), time_});
}

void ResultFiles::claim_indices() {
  folder_.claim(interactions_->bodies().empty() ? std::vector<std::string>{series_file}
                                                : std::vector<std::string>{series_file, bodies_index});
}

void ResultFiles::list(int number, double time) {
  series_.add(result_file(number), time);
  bodies_.list(number, time);
}

void ResultFiles::serialize(Archive& archive, const Comm& comm) {
  archive.scalars("last result", last_, time_);
  archive.numbers("results", saved_);
  if (!archive.reading() || saved_.empty()) return;
  claim_indices();
  write_together(comm, [&] {
    for (std::size_t i = 0; i < saved_.size() && comm.rank() == 0; i += 2)
      list(static_cast<int>(saved_[i]), saved_[i + 1]);
  });
}

}  // namespace bulbus
