#include "app/records/problem_mark.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>

namespace bulbus::inline app {
namespace {

// Uniform in [0, 1), the same for the same number everywhere.
double draw(long long number) {
  const double v = std::sin(12.9898 * static_cast<double>(number % 1000003) + 78.233) * 43758.5453;
  return v - std::floor(v);
}

// Sums over nodes and corners do not depend on who holds them, but for round-off.
std::vector<double> figures_of(const LocalMesh& mesh) {
  const auto drawn = mesh.drawn_places();
  std::vector<double> sums(4);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    for (int k = 0; k < 8; ++k)
      sums[0] += draw(8LL * mesh.input_hex[h] + k) * draw(mesh.input_node[mesh.hexes[h][k]]);
  for (int n = 0; n < mesh.owned; ++n)
    for (int c = 0; c < 3; ++c) sums[1 + c] += draw(mesh.input_node[n]) * drawn[3 * n + c];
  mesh.comm.sum(sums);
  sums.insert(sums.begin(), {static_cast<double>(mesh.all_hexes), static_cast<double>(mesh.all_nodes)});
  return sums;
}

// Of a name, a number below 1e6: FNV-1a, the same in every build.
long long number_of_name(const std::string& name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return static_cast<long long>(hash % 1000003);
}

double sum_of_regions(const LocalMesh& mesh) {
  double sum = 0;
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    for (int k = 0; k < mesh.regions[r].count; ++k)
      sum += draw(number_of_name(mesh.region_names[r])) * draw(mesh.input_hex[mesh.regions[r].first + k]);
  return sum;
}

double sum_of_bars(const LocalMesh& mesh) {
  double sum = 0;
  for (const auto& [name, bars] : mesh.bars)
    for (std::size_t i = 0; i < bars.size(); ++i) {
      const double of_bar = bars[i].share * draw(number_of_name(name) + mesh.input_bar.at(name)[i]);
      for (const auto& [end, factor] : {std::pair{&bars[i].a, 1.}, {&bars[i].b, 2.}})
        for (int k = 0; k < 4; ++k)
          if (end->weights[k] != 0)
            sum += of_bar * factor * end->weights[k] * draw(mesh.input_node[end->nodes[k]]);
    }
  return sum;
}

double sum_of_surfaces(const LocalMesh& mesh) {
  double sum = 0;
  for (const auto& [name, faces] : mesh.surfaces)
    for (const Quad& q : faces)
      for (int n : q) sum += draw(number_of_name(name) + mesh.input_node[n]);
  return sum;
}

double sum_of_sets(const LocalMesh& mesh) {
  double sum = 0;
  for (const auto& [name, nodes] : mesh.sets)
    for (int n : nodes)
      if (n < mesh.owned) sum += draw(number_of_name(name) + mesh.input_node[n]);
  return sum;
}

// As `named_things` lists them.
std::vector<double> named_figures_of(const LocalMesh& mesh) {
  std::vector<double> sums{sum_of_regions(mesh), sum_of_bars(mesh), sum_of_surfaces(mesh), sum_of_sets(mesh)};
  mesh.comm.sum(sums);
  return sums;
}

constexpr std::array named_things{"regions", "bars", "surfaces", "node sets"};

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  double size = 0, gap = 0;
  for (std::size_t i = 0; i < b.size(); ++i) size += std::abs(b[i]), gap += std::abs(a.at(i) - b[i]);
  return a.size() == b.size() && gap <= 1e-9 * size;
}

Scene without_its_course(Scene scene, const Model& model, int step) {
  scene.title.clear();
  MeshSource names;  // however the mesh is made: they say who is held, pressed and made of what
  names.sets = scene.mesh.sets, names.surfaces = scene.mesh.surfaces, names.regions = scene.mesh.regions;
  scene.mesh = names;
  scene.solver = {};
  scene.output = {};
  scene.model = model;
  scene.model.steps.resize(std::min<std::size_t>(step + 1, scene.model.steps.size()));
  for (StepSpec& s : scene.model.steps) s.increments = 1;
  for (auto& [name, body] : scene.model.rigid_bodies)  // wherever the files are
    if (body.file) body.file->path = std::filesystem::path(body.file->path).filename().string();
  return scene;
}

// Hashes by keys.
std::map<std::string, std::string> entries_of(const std::string& files) {
  std::map<std::string, std::string> entries;
  std::istringstream in(files);
  for (std::string line; std::getline(in, line);)
    if (const auto blank = line.find(' '); blank != std::string::npos)
      entries[line.substr(blank + 1)] = line.substr(0, blank);
  return entries;
}

void refuse_changed_files(const ProblemMark& kept, const std::vector<InputFile>& inputs,
                          const std::string& path) {
  const auto then = entries_of(kept.files);
  for (const InputFile& file : inputs)
    if (const auto at = then.find(file.key); at != then.end() && at->second != file.hash())
      throw input_error(fmt::format("{}: is of another problem: {} ({}) has other content than it had then",
                                    path, file.path, file.key),
                        "Restart with the file as it was, or run without --restart.");
}

// The first key of one that the other has otherwise; empty if they agree.
std::string differing_key(const std::string& kept, const std::string& here) {
  const YamlNode a = parse_yaml(kept, "checkpoint"), b = parse_yaml(here, "scene");
  const auto differs = [](const YamlNode& a, const YamlNode* b, const std::string& key) {
    YamlNode only_a = YamlNode::empty(YamlNode::Kind::map), only_b = only_a;
    only_a.insert(key, {}, a);
    if (b) only_b.insert(key, {}, *b);
    return !b || to_yaml(only_a) != to_yaml(only_b);
  };
  for (std::size_t i = 0; i < a.keys.size(); ++i)
    if (differs(a.items[i], b.find(a.keys[i]), a.keys[i])) return a.keys[i];
  for (const std::string& key : b.keys)
    if (!a.find(key)) return key;
  return "";
}

}  // namespace

void ProblemMark::serialize(Archive& archive) {
  archive.text("scene", scene);
  archive.numbers("mesh", mesh);
  if (!archive.reading() || archive.knows("input files")) archive.text("input files", files);
  if (!archive.reading() || archive.knows("named")) archive.numbers("named", named);
}

ProblemMark mark_of(const Scene& scene, const std::vector<InputFile>& inputs, const Problem& problem,
                    int step) {
  std::string files;
  for (const InputFile& file : inputs) files += file.hash() + " " + file.key + "\n";
  return {resolved_yaml(without_its_course(scene, problem.model(), step)), files, figures_of(problem.mesh()),
          named_figures_of(problem.mesh())};
}

void refuse_another(const ProblemMark& kept, const ProblemMark& here, const std::vector<InputFile>& inputs,
                    const std::string& path) {
  refuse_changed_files(kept, inputs, path);
  const std::string remedy = "Restart with the scene that wrote it, or run without --restart.";
  if (kept.mesh.at(0) != here.mesh[0] || kept.mesh.at(1) != here.mesh[1])
    throw input_error(
        fmt::format("{}: is of another mesh: {} hexahedra and {} nodes, where the scene has {} and {}", path,
                    kept.mesh[0], kept.mesh[1], here.mesh[0], here.mesh[1]),
        remedy);
  if (!same(kept.mesh, here.mesh))
    throw input_error(
        path + ": is of another mesh of the same size: its nodes have other positions or other numbers",
        remedy);
  if (const std::string key = kept.scene == here.scene ? "" : differing_key(kept.scene, here.scene);
      !key.empty())
    throw input_error(
        fmt::format("{}: is of another problem: the scene says something else under '{}'{}", path, key,
                    key == "steps" ? ", no later than the step that was under way" : ""),
        remedy);
  for (std::size_t i = 0; i < kept.named.size(); ++i)
    if (!same({kept.named[i]}, {here.named.at(i)}))
      throw input_error(
          fmt::format("{}: is of another mesh with the same nodes: its {} differ", path, named_things.at(i)),
          remedy);
}

}  // namespace bulbus::inline app
