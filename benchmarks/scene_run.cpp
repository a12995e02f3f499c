#include "benchmarks/scene_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/base/process.hpp"

namespace bulbus::bench {
namespace {

namespace fs = std::filesystem;

// Largest magnitude of every column of a history: the scale of a probe that may end near zero.
std::map<std::string, double> scales_of(const fs::path& history) {
  std::map<std::string, double> scales;
  std::vector<std::string> names;
  std::ifstream in(history);
  for (std::string line, cell; std::getline(in, line);) {
    std::stringstream cells(line);
    if (names.empty()) {
      while (std::getline(cells, cell, ',')) names.push_back(cell);
      continue;
    }
    for (std::size_t c = 0; c < names.size() && std::getline(cells, cell, ','); ++c)
      scales[names[c]] = std::max(scales[names[c]], std::abs(std::strtod(cell.c_str(), nullptr)));
  }
  return scales;
}

}  // namespace

std::string scene_file(const std::string& name) { return BULBUS_SOURCE "/data/scenes/" + name + ".yaml"; }

json run_scene(const SceneRun& run) {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_run_" + std::to_string(getpid()));
  std::vector<std::string> arguments{BULBUS_PROGRAM, "run", run.scene, "-o", folder};
  for (const std::string& s : run.set) arguments.insert(arguments.end(), {"--set", s});
  const Ended e = run_process(arguments, run.timeout);
  std::ifstream in(folder / "summary.json");
  const json s = json::parse(in, nullptr, false);
  json row{{"converged", false},
           {"wall_s", e.wall},
           {"cpu_s", e.cpu},
           {"cpu_min", e.cpu / 60},
           {"peak_mb", e.peak_mb}};
  if (s.is_discarded()) {
    row["reason"] = e.reason;
  } else {
    for (const char* key : {"converged", "hexahedra", "steps", "probes", "units"}) row[key] = s[key];
    if (!s["converged"]) row["reason"] = s["reason"];
    row["unknowns"] = s["unknowns"]["total"];
    row["seconds"] = s["seconds"];
    for (const auto& [key, value] : s["totals"].items()) row[key] = value;
    for (const auto& [part, mb] : s["memory_mb"]["parts"].items()) row["memory_mb"][part] = mb["all_ranks"];
    row["scales"] = scales_of(folder / "history.csv");
  }
  fs::remove_all(folder);
  return row;
}

json compared_probes(const json& a, const std::string& name_a, const json& b, const std::string& name_b) {
  std::vector<json> rows;
  if (!a["converged"] || !b["converged"]) return rows;
  for (const auto& [name, value] : a["probes"].items()) {
    json row{{"probe", name}, {"unit", a["units"][name]}, {name_a, value}, {name_b, b["probes"][name]}};
    const double scale = std::max(a["scales"].value(name, 0.), b["scales"].value(name, 0.));
    if (value.is_number() && row[name_b].is_number())
      row["relative"] = scale > 0 ? std::abs(value.get<double>() - row[name_b].get<double>()) / scale : 0;
    rows.push_back(row);
  }
  std::ranges::stable_sort(rows, std::greater{}, [](const json& row) { return row.value("relative", 0.); });
  return rows;
}

}  // namespace bulbus::bench
