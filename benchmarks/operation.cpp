// A whole scene as a user runs it, `bulbus run`, by the iterative and by the direct solver: time, memory, and whether both say the
// same. Each runs as a process of its own, one after the other, on one thread.
//
//     bench_operation [--scene FILE] [--set KEY=VALUE ...] [--n CELLS] [--json FILE] [--timeout SECONDS]
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "benchmarks/common.hpp"
#include "core/base/process.hpp"
#include "core/io/json_file.hpp"

using namespace bulbus::bench;
namespace fs = std::filesystem;

namespace {

struct Given {
  std::string scene = BULBUS_SOURCE "/data/scenes/encircling.yaml";
  std::vector<std::string> set;
  unsigned timeout = 900;  // processor seconds, of each run
};

Given given_in(Options& o) {
  Given given;
  for (std::size_t i = 0; i < o.rest.size(); i += 2) {
    const std::string key = o.rest[i], value = i + 1 < o.rest.size() ? o.rest[i + 1] : "";
    if (key == "--scene") given.scene = value;
    else if (key == "--set") given.set.push_back(value);
    else if (key == "--timeout") given.timeout = std::stoi(value);
    else if (key == "--json") o.out = value;
    else if (key == "--n") o.sizes = {std::stoi(value)};
    else throw std::invalid_argument("unknown option " + key);
  }
  if (!o.sizes.empty()) given.set.push_back("mesh.eye.n=" + std::to_string(o.sizes[0]));
  return given;
}

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

json run(const std::string& method, const Given& given) {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_" + std::to_string(getpid()) + "_" + method);
  std::vector<std::string> arguments{BULBUS_PROGRAM, "run", given.scene, "-o", folder};
  for (const std::string& s : given.set) arguments.insert(arguments.end(), {"--set", s});
  arguments.insert(arguments.end(), {"--set", "solver.linear.method=" + method});
  const bulbus::Ended e = bulbus::run_process(arguments, given.timeout);
  std::ifstream in(folder / "summary.json");
  const json s = json::parse(in, nullptr, false);
  json row{{"method", method}, {"converged", false}, {"wall_s", e.wall}, {"cpu_s", e.cpu}, {"cpu_min", e.cpu / 60}};
  row["peak_mb"] = e.peak_mb;
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

// Every probe by both solvers; the difference relative to the largest magnitude the probe had in either run.
json compared(const json& a, const json& b) {
  std::vector<json> rows;
  if (!a["converged"] || !b["converged"]) return rows;
  for (const auto& [name, value] : a["probes"].items()) {
    json row{{"probe", name}, {"unit", a["units"][name]}, {"iterative", value}, {"direct", b["probes"][name]}};
    const double scale = std::max(a["scales"].value(name, 0.), b["scales"].value(name, 0.));
    if (value.is_number() && row["direct"].is_number())
      row["relative"] = scale > 0 ? std::abs(value.get<double>() - row["direct"].get<double>()) / scale : 0;
    rows.push_back(row);
  }
  std::ranges::stable_sort(rows, std::greater{}, [](const json& row) { return row.value("relative", 0.); });
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Options o = parse(argc, argv, {}, {}, 1);
  Given given = given_in(o);
  if (o.smoke) given.scene = BULBUS_SOURCE "/data/scenes/suture.yaml";
  json report = new_report("operation", o);
  report["parameters"].update({{"scene", fs::path(given.scene).filename()}, {"set", given.set}, {"timeout_s", given.timeout}});
  report["notes"] = "`bulbus run` of the scene as a process of its own; minutes are processor time as the system counts it, peak MB the "
                    "largest resident set; the seconds by part in the record are wall time; probes differ relative to the largest "
                    "magnitude they had in either run";
  for (const char* method : {"iterative", "direct"}) {
    report["rows"].push_back(run(method, given));
    if (!o.out.empty()) bulbus::write_json(o.out, report);  // what is measured so far
  }
  report["probes"] = compared(report["rows"][0], report["rows"][1]);
  finish(report, {"method", "hexahedra", "unknowns", "cpu_s", "wall_s", "peak_mb", "increments", "newton_iterations",
                  "krylov_iterations", "cuts", "converged", "reason"}, o);
  print_table(report["probes"], {"probe", "unit", "iterative", "direct", "relative"});
  const bool agree = !report["probes"].empty() && report["probes"][0].value("relative", 0.) < 1e-3;
  return report["probes"].empty() || (o.smoke && !agree);
}
