#include "app/export/feb_loads.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace bulbus::inline app {
namespace {

using Value = std::function<std::optional<double>(const ExportedStep&)>;

// Why a step cannot be told; empty where it can.
std::string untold_in_feb(const ExportedStep& step, const ExportedStep* before) {
  if (!step.dead.empty()) return "the dead pressure on '" + step.dead.begin()->first + "'";
  for (const auto& [of, values] : step.displacements) {
    if (values.size() > 1) return "the displacement of '" + of.first + "' differs from node to node";
    if (before && !before->displacements.contains(of))
      return "the displacement of '" + of.first + "' begins where an earlier step leads to";
  }
  return "";
}

class Conditions {
 public:
  Conditions(ExportFile& out, const std::vector<ExportedStep>& steps) : out_(out), steps_(steps) {}

  void displacements() {
    if (steps_.empty()) return;
    for (const auto& [of, ignored] : steps_.back().displacements) {
      const int lc = curve([key = of](const ExportedStep& step) -> std::optional<double> {
        const auto at = step.displacements.find(key);
        return at == step.displacements.end() ? std::optional<double>() : at->second[0];
      });
      out_.text("<bc type=\"prescribed displacement\" node_set=\"{}\">\n<dof>{}</dof>\n",
                escaped_markup(of.first), "xyz"[of.second]);
      out_.text("<value lc=\"{}\">1</value>\n<relative>0</relative>\n</bc>\n", lc);
    }
  }

  void loads() {
    if (steps_.empty()) return;
    for (const auto& [surface, ignored] : steps_.back().pressures) {
      const int lc = curve([key = surface](const ExportedStep& step) -> std::optional<double> {
        const auto at = step.pressures.find(key);
        return at == step.pressures.end() ? 0. : at->second;
      });
      out_.text("<surface_load type=\"pressure\" surface=\"{}\">\n", escaped_markup(surface));
      out_.text("<pressure lc=\"{}\">1</pressure>\n<linear>0</linear>\n</surface_load>\n", lc);
    }
    for (const auto& [set, ignored] : steps_.back().forces)
      for (int c = 0; c < 3; ++c) force(set, c);
  }

  void curves() {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      out_.text("<load_controller id=\"{}\" type=\"loadcurve\">\n<interpolate>LINEAR</interpolate>\n", i + 1);
      out_.text("<extend>CONSTANT</extend>\n<points>\n<pt>0,0</pt>\n");
      for (std::size_t k = 0; k < steps_.size(); ++k)
        if (const auto value = curves_[i](steps_[k])) out_.text("<pt>{},{}</pt>\n", k + 1, *value);
      out_.text("</points>\n</load_controller>\n");
    }
  }

 private:
  int curve(Value value) {
    curves_.push_back(std::move(value));
    return static_cast<int>(curves_.size());
  }

  void force(const std::string& set, int c) {
    const int lc = curve([set, c](const ExportedStep& step) -> std::optional<double> {
      const auto at = step.forces.find(set);
      return at == step.forces.end() ? 0. : at->second[c];
    });
    out_.text("<nodal_load type=\"nodal_force\" node_set=\"{}\">\n<value lc=\"{}\">{},{},{}</value>\n",
              escaped_markup(set), lc, c == 0 ? 1 : 0, c == 1 ? 1 : 0, c == 2 ? 1 : 0);
    out_.text("</nodal_load>\n");
  }

  ExportFile& out_;
  const std::vector<ExportedStep>& steps_;
  std::vector<Value> curves_;
};

void write_step(ExportFile& out, const ExportedStep& step, int number) {
  out.text("<step id=\"{}\" name=\"{}\">\n<Control>\n<analysis>STATIC</analysis>\n", number,
           escaped_markup(step.name.empty() ? "step " + std::to_string(number) : step.name));
  const double size = 1. / step.increments;
  out.text("<time_steps>{}</time_steps>\n<step_size>{}</step_size>\n", step.increments, size);
  out.text("<solver type=\"solid\">\n<max_refs>25</max_refs>\n</solver>\n<time_stepper type=\"default\">\n");
  out.text("<max_retries>10</max_retries>\n<opt_iter>10</opt_iter>\n<dtmin>{}</dtmin>\n<dtmax>{}</dtmax>\n",
           1e-3 * size, size);
  out.text("</time_stepper>\n</Control>\n</step>\n");
}

}  // namespace

void cut_steps_for_feb(ExportedModel& model) {
  for (std::size_t k = 0; k < model.steps.size(); ++k) {
    const std::string reason = untold_in_feb(model.steps[k], k > 0 ? &model.steps[k - 1] : nullptr);
    if (reason.empty()) continue;
    model.left_out.push_back(
        fmt::format("step {} '{}' and those after it: {}", k + 1, model.steps[k].name, reason));
    model.steps.resize(k);
    return;
  }
}

void write_feb_loads(ExportFile& out, const ExportedModel& model) {
  Conditions conditions(out, model.steps);
  out.text("<Boundary>\n");
  for (const auto& [set, directions] : model.fixed) {
    out.text("<bc type=\"zero displacement\" node_set=\"{}\">\n", escaped_markup(set));
    for (int c = 0; c < 3; ++c) out.text("<{}_dof>{}</{}_dof>\n", "xyz"[c], directions[c] ? 1 : 0, "xyz"[c]);
    out.text("</bc>\n");
  }
  conditions.displacements();
  out.text("</Boundary>\n<Loads>\n");
  conditions.loads();
  out.text("</Loads>\n<LoadData>\n");
  conditions.curves();
  out.text("</LoadData>\n");
  if (model.steps.empty()) return;
  out.text("<Step>\n");
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    write_step(out, model.steps[k], static_cast<int>(k + 1));
  out.text("</Step>\n");
}

std::string in_comment(const std::string& text) {
  std::string plain = text;
  for (std::size_t at; (at = plain.find("--")) != std::string::npos;) plain.replace(at, 2, "- ");
  return plain;
}

}  // namespace bulbus::inline app
