#include "app/export/exported_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/export/untold_step.hpp"
#include "core/base/sort_unique.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/formula.hpp"
#include "core/problem/set_motion.hpp"

namespace bulbus::inline app {
namespace {

class ModelExport {
 public:
  ModelExport(const Model& model, const Mesh& mesh) : model_(model), mesh_(mesh) {
    made_.sets = mesh.node_sets;
    for (auto& [name, nodes] : made_.sets) sort_unique(nodes);
  }

  ExportedModel take() {
    add_fixed();
    add_printed();
    tell_left_out();
    for (int step = 0; step < static_cast<int>(model_.steps.size()); ++step) {
      if (const std::string reason = untold(model_, mesh_, step); !reason.empty()) {
        made_.left_out.push_back(fmt::format(
            "{}{}: {}", title(step),
            step + 1 < static_cast<int>(model_.steps.size()) ? " and those after it" : "", reason));
        break;
      }
      add_step(step);
    }
    return std::move(made_);
  }

 private:
  std::string title(int step) const {
    const std::string& name = model_.steps[step].name;
    return fmt::format("step {}{}", step + 1, name.empty() ? "" : " '" + name + "'");
  }

  const std::vector<int>& nodes_in(const std::string& set) {
    const auto [at, fresh] = made_.sets.try_emplace(set);
    if (fresh) at->second = nodes_of(mesh_, set);
    return at->second;
  }

  void add_fixed() {
    const double tolerance = mesh_tolerance(mesh_);
    for (const std::string& plane : model_.symmetry) {
      std::string name = "symmetry_" + plane;
      while (made_.sets.contains(name) || mesh_.surfaces.contains(name) || region_index(mesh_, name) >= 0)
        name += "_";
      for (int n = 0; n < static_cast<int>(mesh_.points.size()); ++n)
        if (std::abs(mesh_.points[n][axis_of(plane)]) <= tolerance) made_.sets[name].push_back(n);
      ExportedModel::Fixed fixed{name};
      fixed.directions[axis_of(plane)] = true;
      if (made_.sets.contains(name)) made_.fixed.push_back(fixed);
    }
    for (const FixSpec& fix : model_.fix) {
      nodes_in(fix.set);
      ExportedModel::Fixed fixed{fix.set};
      for (const std::string& d : fix.directions) fixed.directions[axis_of(d)] = true;
      made_.fixed.push_back(fixed);
    }
  }

  void add_printed() {
    std::string others;
    for (const ProbeSpec& probe : model_.probes) {
      const bool told = probe.kind == "displacement" || probe.kind == "position" || probe.kind == "reaction";
      if (told) nodes_in(probe.set);
      if (told)
        made_.printed.insert(probe.set);
      else
        others += (others.empty() ? "" : ", ") + probe.name;
    }
    if (!others.empty())
      made_.left_out.push_back("probes that are no displacement, position or reaction: " + others);
  }

  void tell_left_out() {
    for (const auto& [name, region] : model_.regions)
      if (region.rigid)
        made_.left_out.push_back("region '" + name + "' is rigid: it is written without a material");
    for (const auto& [name, bars] : mesh_.bars)
      made_.left_out.push_back(fmt::format("bars '{}' ({} of them)", name, bars.size()));
    const auto tell = [&](const std::string& what) { made_.left_out.push_back(what); };
    for (const auto& [name, body] : model_.rigid_bodies) tell("rigid body '" + name + "'");
    for (const ContactSpec& contact : model_.contacts) tell("contact '" + contact.name + "'");
    for (const auto& [name, suture] : model_.sutures) tell("suture '" + name + "'");
  }

  void add_step(int index) {
    const StepSpec& spec = model_.steps[index];
    now_.name = spec.name;
    now_.increments = spec.increments;
    const std::string key = fmt::format("steps.{}.", index);
    for (std::size_t i = 0; i < spec.displace.size(); ++i)
      add_displacement(spec.displace[i], index, fmt::format("{}displace.{}", key, i));
    for (std::size_t i = 0; i < spec.loads.size(); ++i)
      add_load(spec.loads[i], index, fmt::format("{}loads.{}", key, i));
    for (const auto& [name, pressure] : spec.pressures)
      of_liquids_[model_.liquids.at(name).surface] =
          at_end(pressure, index, key + "pressures." + name, "the pressure of liquid '" + name + "'");
    now_.pressures = of_loads_;
    for (const auto& [surface, pressure] : of_liquids_) now_.pressures[surface] += pressure;
    made_.steps.push_back(now_);
  }

  // Of a formula in s and t: the file goes there linearly.
  double at_end(const std::string& text, int step, const std::string& key, const std::string& what,
                const Point& X = {}) {
    const Formula formula(text, key);
    if (!formula.constant() && told_.insert(key).second)
      made_.left_out.push_back(fmt::format(
          "{}: the formula of {}; the file goes linearly to its value at the end", title(step), what));
    return formula({X[0], X[1], X[2]}, 1, step + 1);
  }

  void add_displacement(const DisplaceSpec& spec, int step, const std::string& key) {
    const std::vector<int>& nodes = nodes_in(spec.set);
    const auto take = [&](int direction, auto value) {
      std::vector<double> values;
      for (int n : nodes) values.push_back(value(mesh_.points[n]));
      if (std::ranges::all_of(values, [&](double v) { return v == values[0]; })) values.resize(1);
      now_.displacements[{spec.set, direction}] = std::move(values);
    };
    if (spec.rotate)
      made_.left_out.push_back(
          fmt::format("{}: the arcs of the rotation of '{}'; in the file nodes go there on straight lines",
                      title(step), spec.set));
    const std::array<const std::optional<std::string>*, 3> own{&spec.x, &spec.y, &spec.z};
    for (int c = 0; c < 3; ++c) {
      if (*own[c])
        take(c, [&](const Point& X) {
          return at_end(**own[c], step, key, "the displacement of '" + spec.set + "'", X);
        });
      if (spec.affine || spec.rotate || spec.translate)
        take(c, [&](const Point& X) {
          return (spec.affine ? affine_image(spec, X) : rigidly_moved(spec, X, 1))[c] - X[c];
        });
    }
  }

  void add_load(const LoadSpec& spec, int step, const std::string& key) {
    if (spec.pressure) {
      const double p = at_end(*spec.pressure, step, key, "the pressure on '" + spec.surface + "'");
      now_.dead.erase(spec.surface);
      if (spec.dead) now_.dead[spec.surface] = {spec.direction, p};
      if (!spec.dead || of_loads_.contains(spec.surface)) of_loads_[spec.surface] = spec.dead ? 0 : p;
    }
    if (!spec.force) return;
    nodes_in(spec.set);
    now_.forces[spec.set] = *spec.force;
  }

  const Model& model_;
  const Mesh& mesh_;
  ExportedModel made_;
  ExportedStep now_;
  std::map<std::string, double> of_liquids_, of_loads_;
  std::set<std::string> told_;
};

}  // namespace

ExportedModel exported_model(const Model& model, const Mesh& mesh) { return ModelExport(model, mesh).take(); }

}  // namespace bulbus::inline app
