#include "app/report/body_json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/records/record_names.hpp"
#include "app/report/pack.hpp"
#include "core/io/vtp_read.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

// Empty where one of them is missing.
std::vector<SavedPolygons> read_all(const RunRecord& run, const std::vector<int>& frames,
                                    std::string (*name)(int)) {
  std::vector<SavedPolygons> all;
  for (int f : frames) {
    const std::string path = run.folder + "/" + name(run.frames[f].increment);
    if (!std::filesystem::exists(path)) return {};
    all.push_back(read_vtp(path));
  }
  return all;
}

// Names of "body_band" and so on by their values.
json names_of(const std::vector<Label>& labels, const std::string& start) {
  json names = json::array();
  for (const Label& label : labels)
    if (label.name.starts_with(start) && label.value >= 0)
      names[label.value] = label.name.substr(start.size());
  return names;
}

std::vector<float> floats(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }

std::vector<std::uint32_t> whole(const std::vector<double>& numbers) {
  return {numbers.begin(), numbers.end()};
}

}  // namespace

json packed_states(const std::vector<std::vector<std::uint16_t>>& states) {
  json list = json::array();
  for (std::size_t s = 0; s < states.size(); ++s)
    list.push_back(s == 0 ? packed(states[s]) : packed(states[s], states[s - 1]));
  return list;
}

json places_json(const std::vector<std::vector<float>>& states) {
  float low = INFINITY, high = -INFINITY;
  for (const auto& state : states)
    for (float x : state) low = std::min(low, x), high = std::max(high, x);
  if (!(low <= high)) low = high = 0;
  std::vector<std::vector<std::uint16_t>> quanta;
  for (const auto& state : states) quanta.push_back(quantised(state, low, high));
  return {{"low", low}, {"high", high}, {"values", packed_states(quanta)}};
}

json bodies_json(const RunRecord& run, const std::vector<int>& frames) {
  const std::vector<SavedPolygons> all = read_all(run, frames, bodies_file);
  if (all.empty() || all.front().triangles.empty()) return {};
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : all.front().triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  std::vector<std::vector<float>> states;
  for (const SavedPolygons& polygons : all) {
    if (polygons.points.size() != all.front().points.size())
      throw std::runtime_error(run.folder + ": the files of rigid bodies have different numbers of points");
    states.push_back(floats(polygons.points));
  }
  return {{"names", names_of(all.front().labels, "body_")},
          {"body", packed(whole(all.front().field("body")), 1)},
          {"triangles", packed(corners, 3)},
          {"positions", places_json(states)}};
}

json lines_json(const RunRecord& run, const std::vector<int>& frames) {
  const std::vector<SavedPolygons> all = read_all(run, frames, lines_file);
  if (all.empty()) return {};
  json states = json::array();
  for (const SavedPolygons& lines : all) {
    std::vector<float> ends;
    for (const auto& line : lines.lines)
      for (int n : line)
        for (std::size_t c = 0; c < 3; ++c) ends.push_back(static_cast<float>(lines.points[3 * n + c]));
    states.push_back({{"ends", places_json({ends})},
                      {"group", packed(whole(lines.field("group")), 1)},
                      {"force", lines.field("force")}});
  }
  json names = names_of(all.front().labels, "group_");
  for (json& name : names)
    if (run.scene && name.is_string() && run.scene->model.sutures.contains(name))
      name = "suture " + name.get<std::string>();
  return {{"names", names}, {"states", states}};
}

}  // namespace bulbus::inline app
