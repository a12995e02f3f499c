#include "app/report/shown_states.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/records/record_names.hpp"
#include "core/io/hdf5_read.hpp"

namespace bulbus::inline app {
namespace {

const std::string points_group = "VTKHDF/PointData", cells_group = "VTKHDF/CellData";

std::string file_of(const RunRecord& run, int frame) {
  return run.folder + "/" + result_file(run.frames[frame].increment);
}

bool has(const std::string& path, const std::string& group, const std::string& name) {
  return std::ranges::count(names_in(path, group), name) > 0;
}

// `width` numbers for each of those that are shown.
std::vector<float> picked(const std::vector<double>& all, const std::vector<int>& which, std::size_t width,
                          std::size_t count, const std::string& path) {
  if (all.size() != width * count) throw std::runtime_error(path + ": has another mesh than the first state");
  std::vector<float> some;
  some.reserve(width * which.size());
  for (int i : which)
    for (std::size_t c = 0; c < width; ++c) some.push_back(static_cast<float>(all[width * i + c]));
  return some;
}

std::vector<std::string> names_of_regions(const SavedMesh& mesh, const std::vector<int>& regions) {
  const int largest = regions.empty() ? 0 : *std::ranges::max_element(regions);
  std::vector<std::string> names;
  for (int r = 0; r <= largest; ++r) names.push_back("region " + std::to_string(r));
  const std::string start = "region_";
  for (const Label& label : mesh.labels)
    if (label.name.starts_with(start) && label.value >= 0 && label.value <= largest)
      names[label.value] = label.name.substr(start.size());
  return names;
}

}  // namespace

SavedSolid read_solid(const RunRecord& run) {
  const std::string first = file_of(run, 0), last = file_of(run, static_cast<int>(run.frames.size()) - 1);
  SavedSolid saved{read_vtkhdf_mesh(first), {}, {}};
  const std::size_t cells = saved.mesh.hexes.size();
  std::vector<double> region(cells, 0), displacement(3 * saved.mesh.points.size(), 0);
  if (has(first, cells_group, "region")) region = read_dataset(first, cells_group + "/region");
  if (has(last, points_group, "displacement"))
    displacement = read_dataset(last, points_group + "/displacement");
  if (region.size() != cells || displacement.size() != 3 * saved.mesh.points.size())
    throw std::runtime_error(last + ": has another mesh than the first state");
  for (double r : region) saved.regions.push_back(static_cast<int>(r));
  saved.region_names = names_of_regions(saved.mesh, saved.regions);
  join_pieces(saved.mesh, displacement, 3);
  return saved;
}

std::vector<ShownField> shown_fields(const RunRecord& run) {
  const std::string path = file_of(run, static_cast<int>(run.frames.size()) - 1);
  std::vector<ShownField> fields;
  if (has(path, cells_group, "mises")) fields.push_back({"mises", "MPa", true, {}});
  for (const std::string& name : names_in(path, points_group)) {
    if (name.starts_with("contact_pressure")) fields.push_back({name, "MPa", false, {}});
    if (name.starts_with("gap")) fields.push_back({name, "mm", false, {}});
  }
  return fields;
}

ShownStates read_states(const RunRecord& run, const std::vector<int>& frames, const SavedSolid& saved,
                        const ShownSolid& shown) {
  const std::size_t nodes = saved.mesh.points.size(), cells = saved.mesh.hexes.size();
  ShownStates states{{}, {}, shown_fields(run)};
  for (int n : shown.nodes)
    for (double x : saved.mesh.points[n]) states.reference.push_back(static_cast<float>(x));
  for (int frame : frames) {
    const std::string path = file_of(run, frame);
    std::vector<float> x = states.reference;
    if (has(path, points_group, "displacement")) {
      const auto u = picked(read_dataset(path, points_group + "/displacement"), shown.nodes, 3, nodes, path);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += u[i];
    }
    states.positions.push_back(std::move(x));
    for (ShownField& f : states.fields) {
      const auto all = read_dataset(path, (f.on_cells ? cells_group : points_group) + "/" + f.name);
      f.values.push_back(f.on_cells ? picked(all, shown.cells, 1, cells, path)
                                    : picked(all, shown.nodes, 1, nodes, path));
    }
  }
  return states;
}

}  // namespace bulbus::inline app
