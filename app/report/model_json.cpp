#include "app/report/model_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/report/body_json.hpp"
#include "app/report/pack.hpp"
#include "app/report/shown_states.hpp"
#include "app/report/thinning.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

// Bytes of a page per value of a state and per node of a hexahedron: more than has been seen.
constexpr double bytes_of_value = 1, bytes_of_corner = .7;

double diagonal(const SavedMesh& mesh) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto by = [&](const Point& a, const Point& b) { return a[c] < b[c]; };
    const auto [low, high] = std::ranges::minmax_element(mesh.points, by);
    square += low == mesh.points.end() ? 0 : std::pow((*high)[c] - (*low)[c], 2);
  }
  return std::sqrt(square);
}

double expected_bytes(const ShownSolid& solid, std::size_t frames, const std::vector<ShownField>& fields) {
  double values = 3. * static_cast<double>(solid.nodes.size());
  for (const ShownField& f : fields)
    values += static_cast<double>((f.on_cells ? solid.cells : solid.nodes).size());
  const double corners =
      8. * static_cast<double>(solid.hexes.size()) + 4. * static_cast<double>(solid.faces.size());
  return bytes_of_value * values * static_cast<double>(frames) + bytes_of_corner * corners;
}

json frames_json(const RunRecord& run, const std::vector<int>& frames) {
  json list = json::array();
  for (int f : frames) list.push_back({{"time", run.frames[f].time}, {"label", run.frames[f].label}});
  return list;
}

json field_json(const ShownField& field) {
  float low = INFINITY, high = -INFINITY;
  for (const auto& values : field.values)
    for (float v : values)
      if (!std::isnan(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(low <= high)) low = high = 0;
  std::vector<std::vector<std::uint16_t>> quanta;
  for (const auto& values : field.values) quanta.push_back(quantised(values, low, high));
  return {{"name", field.name}, {"unit", field.unit}, {"on", field.on_cells ? "cells" : "nodes"},
          {"low", low},         {"high", high},       {"values", packed_states(quanta)}};
}

template <class Rows, class Take>
std::vector<std::uint32_t> flat(const Rows& rows, Take take) {
  std::vector<std::uint32_t> all;
  for (const auto& row : rows)
    for (int n : take(row)) all.push_back(static_cast<std::uint32_t>(n));
  return all;
}

json solid_json(const ShownSolid& solid, const ShownStates& states, const std::vector<std::string>& names) {
  std::vector<std::vector<float>> all = states.positions;
  all.push_back(states.reference);
  json places = places_json(all);             // the last is the reference
  std::vector<std::uint32_t> owners, others;  // regions beyond from 1, 0: none
  for (const ShownFace& face : solid.faces) {
    owners.push_back(static_cast<std::uint32_t>(face.cell));
    others.push_back(static_cast<std::uint32_t>(face.other + 1));
  }
  const std::vector<std::uint32_t> regions(solid.regions.begin(), solid.regions.end());
  json s{{"nodes", solid.nodes.size()},
         {"cells", solid.cells.size()},
         {"faces", solid.faces.size()},
         {"region_names", names},
         {"regions", packed(regions, 1)},
         {"positions", places},
         {"face_nodes", packed(flat(solid.faces, [](const ShownFace& f) { return f.nodes; }), 4)},
         {"face_cells", packed(owners, 1)},
         {"face_others", packed(others, 1)},
         {"fields", json::array()}};
  if (!solid.hexes.empty()) s["hexes"] = packed(flat(solid.hexes, [](const Hex& h) { return h; }), 8);
  for (const ShownField& f : states.fields) s["fields"].push_back(field_json(f));
  return s;
}

json notes_of(const RunRecord& run, const std::vector<int>& frames, const Thinning& t, double size) {
  json notes = json::array();
  if (frames.size() < run.frames.size())
    notes.push_back(
        fmt::format("The page shows {} of the {} saved states.", frames.size(), run.frames.size()));
  if (!t.inside)
    notes.push_back(
        "The page shows the surfaces of the regions alone, so that cuts are open: the inside would make it "
        "too large.");
  if (t.cube > 0)
    notes.push_back(fmt::format("Nodes of the surfaces within {:.2g} mm are drawn as one.", t.cube * size));
  if (!notes.empty()) notes.push_back("Everything is in the result files.");
  return notes;
}

std::size_t bytes_of(const json& value) { return value.dump().size(); }

}  // namespace

json model_json(const RunRecord& run, double limit) {
  if (run.frames.empty()) return {};
  const SavedSolid saved = read_solid(run);
  const ShownSolid whole = whole_solid(saved.mesh, saved.regions), surface = surface_of(whole);
  const std::vector<ShownField> fields = shown_fields(run);
  const double size = diagonal(saved.mesh);
  const std::vector<Thinning> all = thinnings();
  for (const Thinning& t : all) {
    const bool last = &t == &all.back();
    const std::vector<int> frames = chosen_frames(run, t.states);
    const ShownSolid solid = t.inside     ? whole
                             : t.cube > 0 ? clustered(surface, saved.mesh.points, t.cube * size)
                                          : surface;
    if (!last && expected_bytes(solid, frames.size(), fields) > limit) continue;
    json model{{"title", run.title()}, {"frames", frames_json(run, frames)}, {"symmetry", json::array()}};
    if (run.scene) model["symmetry"] = run.scene->model.symmetry;
    model["solid"] = solid_json(solid, read_states(run, frames, saved, solid), saved.region_names);
    model["bodies"] = bodies_json(run, frames);
    model["lines"] = lines_json(run, frames);
    model["notes"] = notes_of(run, frames, t, size);
    if (last || static_cast<double>(bytes_of(model)) <= limit) return model;
  }
  return {};
}

}  // namespace bulbus::inline app
