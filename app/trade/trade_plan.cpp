#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "app/scene/text_format.hpp"
#include "app/scene/unused.hpp"
#include "app/trade/trade.hpp"

namespace bulbus::inline app {
namespace {

using Settings = std::vector<std::string>;

/// Keys of the scene that all take the value.
struct Parameter {
  std::string name;
  std::vector<std::string> keys, values;
};

const std::vector<Parameter> parameters{
    {"newton",
     {"solver.newton.force", "solver.newton.volume", "solver.newton.liquid"},
     {"1e-2", "1e-3", "1e-4", "1e-5"}},
    {"intermediate tolerance", {"solver.newton.intermediate"}, {"1e2", "1e4"}},
    {"increments", {"solver.stepping.increments"}, {".25", ".5", "2"}},
    {"eta_max", {"solver.newton.eta_max"}, {"1e-2", "3e-3", "1e-4"}},
    {"reuse", {"solver.linear.reuse"}, {"0", "2"}},
    {"gamma", {"solver.linear.gamma"}, {"2", "5", "10"}},
    {"smoothing", {"solver.linear.smoothing"}, {"single", "double"}},
    {"degree", {"solver.linear.aggregation.degree"}, {"6", "8", "12"}},
    {"operator", {"solver.linear.operator"}, {"recompute", "cache", "assembled"}},
    {"iterations before the correction", {"solver.linear.pressures.after"}, {"0", "40", "100000"}},
    {"method", {"solver.linear.method"}, {"direct"}}};

const Settings reference{"solver.newton.force=1e-9",       "solver.newton.volume=1e-9",
                         "solver.newton.liquid=1e-10",     "solver.newton.eta_max=1e-3",
                         "solver.linear.smoothing=double", "solver.linear.reuse=0",
                         "solver.linear.method=iterative"};

Settings joined(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Every contact's penalty, that of the scene times a factor.
Settings penalties(const Prepared& prepared, double factor) {
  Settings set;
  for (const auto& contact : prepared.interactions->contacts())
    set.push_back(fmt::format("contacts.{}.penalty={:.6g}", contact.spec.name, factor * contact.penalty));
  return set;
}

Settings augmentation(const Prepared& prepared, const char* tolerance) {
  Settings set;
  for (const auto& contact : prepared.interactions->contacts())
    set.push_back(fmt::format("contacts.{}.tolerance={}", contact.spec.name, tolerance));
  return set;
}

// Cells of the generated shape, by key.
std::vector<std::pair<std::string, int>> cells_of(const MeshSource& mesh) {
  if (mesh.eye) return {{"mesh.eye.n", mesh.eye->n}};
  if (mesh.block)
    return {{"mesh.block.nx", mesh.block->nx},
            {"mesh.block.ny", mesh.block->ny},
            {"mesh.block.nz", mesh.block->nz}};
  if (mesh.shell) return {{"mesh.shell.n", mesh.shell->n}, {"mesh.shell.layers", mesh.shell->layers}};
  if (mesh.ball) return {{"mesh.ball.n", mesh.ball->n}, {"mesh.ball.layers", mesh.ball->layers}};
  if (const auto& c = mesh.cylinder; c)
    return {
        {"mesh.cylinder.n", c->n}, {"mesh.cylinder.rings", c->rings}, {"mesh.cylinder.layers", c->layers}};
  return {};
}

// A wall's cells through its thickness, twice as many as they are.
std::optional<TradeMesh> layered(const MeshSource& mesh) {
  const auto twice = [](const char* shape, int layers) {
    return TradeMesh{
        fmt::format("layers {}", 2 * layers), {}, {fmt::format("mesh.{}.layers={}", shape, 2 * layers)}};
  };
  if (mesh.eye) return twice("eye", mesh.eye->layers);
  if (mesh.shell) return twice("shell", mesh.shell->layers);
  return {};
}

// Counts of cells stay even where they are, as an eye's must be.
int scaled(int count, double factor) {
  const int step = count % 2 ? 1 : 2;
  return std::max(step, static_cast<int>(std::lround(factor * count / step)) * step);
}

void add_count(std::string& words, const std::string& key, int count) {
  words += fmt::format("{}{} {}", words.empty() ? "" : ", ", key.substr(key.rfind('.') + 1), count);
}

// h is the geometric mean of what rounding makes of the factor, where it leaves no count as it is.
TradeMesh mesh_with(const std::vector<std::pair<std::string, int>>& cells, double factor) {
  TradeMesh mesh;
  double log_h = 0;
  for (const auto& [key, count] : cells) {
    const int now = scaled(count, factor);
    add_count(now == count ? mesh.kept : mesh.words, key, now);
    log_h += std::log(static_cast<double>(count) / now) / static_cast<double>(cells.size());
    mesh.set.push_back(key + "=" + std::to_string(now));
  }
  if (mesh.kept.empty()) mesh.h = std::exp(log_h);
  return mesh;
}

class Planner {
 public:
  Planner(const std::string& path, Settings overrides)
      : trade_{path, {}, {}}, overrides_(std::move(overrides)) {}

  /// Nothing if there is such a run already. Returns its number.
  int add(const std::string& parameter, const std::string& value, const Settings& set, int mesh = 0) {
    const std::string name = fmt::format("run_{:03d}", trade_.runs.size() + 1);
    TradeRun run{
        name,  parameter,
        value, joined({"output.vtk=false"}, joined(overrides_, joined(trade_.meshes[mesh].set, set))),
        mesh,  {}};
    run.scene = scene_with(run.set);
    const std::string way = way_of(run.scene);
    if (const auto same = std::ranges::find(ways_, way); same != ways_.end())
      return static_cast<int>(same - ways_.begin());
    ways_.push_back(way);
    trade_.runs.push_back(std::move(run));
    return static_cast<int>(trade_.runs.size()) - 1;
  }
  int mesh(TradeMesh mesh) {
    trade_.meshes.push_back(std::move(mesh));
    return static_cast<int>(trade_.meshes.size()) - 1;
  }
  /// Runs with these accuracies on another mesh, whose errors count from the first of them.
  void add_on(const TradeMesh& other, std::initializer_list<const char*> accuracies) {
    const int number = mesh(other);
    for (const char* accuracy : accuracies) {
      const int run =
          add("mesh", other.words + ", " + accuracy, {std::string("solver.accuracy=") + accuracy}, number);
      if (trade_.meshes[number].reference < 0) trade_.meshes[number].reference = run;
    }
  }
  Scene scene_on(const TradeMesh& mesh) const {
    Settings set = joined(overrides_, mesh.set);
    return scene_with(set);
  }
  Trade& trade() { return trade_; }

 private:
  // Where the method of a run has no use for a setting of the scene or of a parameter, the set gives it the
  // value that it would have without.
  Scene scene_with(Settings& set) const {
    const YamlNode root = scene_data(trade_.scene, set);
    Scene scene = scene_of(root, trade_.scene);
    for (const UnusedSetting& u : unused_settings(root, scene))
      if (u.differs()) set.push_back(u.key + "=" + u.otherwise);
    return scene_of(scene_data(trade_.scene, set), trade_.scene);
  }
  // By what words a scene's settings are called is all the same.
  static std::string way_of(Scene scene) {
    scene.solver.accuracy = SolverSettings().accuracy;
    return resolved_yaml(scene);
  }

  Trade trade_;
  Settings overrides_;
  std::vector<std::string> ways_;  // of the runs
};

// The first of these sizes of cells that the scene is at home on: sets of an eye may need certain numbers of
// cells.
std::optional<TradeMesh> fitting_mesh(const Planner& planner,
                                      const std::vector<std::pair<std::string, int>>& cells,
                                      std::span<const double> factors, const Comm& comm) {
  if (cells.empty()) return {};  // of a file, which has the cells that it has
  for (double factor : factors) {
    const TradeMesh mesh = mesh_with(cells, factor);
    if (mesh.words.empty() || (mesh.h && std::abs(*mesh.h - 1) < .1)) continue;
    try {
      prepare(planner.scene_on(mesh), comm);
      return mesh;
    } catch (const InputError&) {
    }
  }
  return {};
}

}  // namespace

Trade plan_trade(const std::string& scene, const std::vector<std::string>& overrides,
                 const Prepared& prepared) {
  const Scene given = read_scene(scene, overrides);
  const auto cells = cells_of(given.mesh);
  Planner planner(scene, overrides);
  planner.mesh({mesh_with(cells, 1).kept, 1, {}});
  planner.trade().meshes[0].reference = planner.add("reference", "", reference);
  planner.add("scene", "accuracy " + word_of(given.solver.accuracy), {});
  for (const char* accuracy : {"fast", "balanced", "tight"})
    planner.add("accuracy", accuracy, {std::string("solver.accuracy=") + accuracy});
  for (const auto& factors : {std::array{.7, .6, .5}, std::array{1.3, 1.45, 1.6}}) {
    const auto mesh = fitting_mesh(planner, cells, factors, prepared.problem->comm());
    if (mesh) planner.add_on(*mesh, {"tight", "balanced", "fast"});
  }
  if (const auto mesh = layered(given.mesh)) planner.add_on(*mesh, {"tight"});
  for (const Parameter& parameter : parameters)
    for (const std::string& value : parameter.values) {
      Settings set;
      for (const std::string& key : parameter.keys) set.push_back(key + "=" + value);
      planner.add(parameter.name, value, set);
    }
  for (double factor : {.3, 3.})
    planner.add("penalty", fmt::format("x {:g}", factor), penalties(prepared, factor));
  planner.add("augmentation", "1e-3 mm", augmentation(prepared, "1e-3"));
  return planner.trade();
}

}  // namespace bulbus::inline app
