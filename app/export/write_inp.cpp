#include <algorithm>
#include <cmath>
#include <set>

#include "app/export/export_file.hpp"
#include "app/export/export_scene.hpp"
#include "app/export/exported_material.hpp"
#include "app/export/inp_mesh.hpp"
#include "core/problem/loads.hpp"

namespace bulbus::inline app {
namespace {

constexpr int highest_order = 3;  // of CalculiX

class InpModel {
 public:
  InpModel(const ExportContent& content)
      : content_(content), made_(content.told), names_(content.mesh, made_.sets, made_.left_out) {
    for (const std::string& region : content.mesh.region_names)
      if (const int order = exported_material(law(region)).order(); order > highest_order)
        made_.left_out.push_back(
            fmt::format("region '{}' has powers up to {}, the programs read {}: it is written without a "
                        "material",
                        region, order, highest_order));
  }

  std::vector<std::string> write(const std::string& path) {
    ExportFile out(path);
    out.text("*HEADING\n{}\n", content_.heading);
    for (const std::string& sentence : made_.left_out) out.text("** not in this file: {}\n", sentence);
    write_inp_mesh(out, content_.mesh, made_.sets, names_, content_.options.element);
    for (const std::string& region : content_.mesh.region_names) material(out, region);
    fixed(out);
    for (const ExportedStep& step : made_.steps) write(out, step);
    out.flush();
    return made_.left_out;
  }

 private:
  const RegionSpec& law(const std::string& region) const { return content_.model.regions.at(region); }

  // Hybrid elements are incompressible where D1 is zero.
  double compressibility(const ExportedMaterial& material) const {
    return content_.options.element.ends_with('H') ? 0 : 2 / (content_.options.bulk * material.shear());
  }

  void material(ExportFile& out, const std::string& region) const {
    const std::string& name = names_.regions.of(region);
    const ExportedMaterial m = exported_material(law(region));
    if (!law(region).rigid && m.order() <= highest_order) {
      out.text("*MATERIAL, NAME={}\n*HYPERELASTIC, ", name);
      const std::string D1 = decimal(compressibility(m));
      if (m.order() == 1 && m.coefficient(0, 1) == 0)
        out.text("NEO HOOKE\n{}, {}\n", decimal(m.coefficient(1, 0)), D1);
      else if (m.order() == 1)
        out.text("MOONEY-RIVLIN\n{}, {}, {}\n", decimal(m.coefficient(1, 0)), decimal(m.coefficient(0, 1)),
                 D1);
      else
        polynomial(out, m, D1);
    }
    out.text("*SOLID SECTION, ELSET={}, MATERIAL={}\n", name, name);
  }

  // c10, c01, c20, c11, c02, c30, ..., then D1 and zeros; eight on a line.
  static void polynomial(ExportFile& out, const ExportedMaterial& m, const std::string& D1) {
    std::vector<std::string> numbers;
    for (int order = 1; order <= m.order(); ++order)
      for (int s = 0; s <= order; ++s) numbers.push_back(decimal(m.coefficient(order - s, s)));
    numbers.push_back(D1);
    numbers.resize(numbers.size() + m.order() - 1, "0.");
    out.text("POLYNOMIAL, N={}\n", m.order());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      out.text("{}{}", numbers[i], i % 8 == 7 || i + 1 == numbers.size() ? "\n" : ", ");
  }

  void fixed(ExportFile& out) const {
    if (!made_.fixed.empty()) out.text("*BOUNDARY\n");
    for (const auto& [set, directions] : made_.fixed)
      for (int c = 0; c < 3; ++c)
        if (directions[c]) out.text("{}, {}, {}\n", names_.sets.of(set), c + 1, c + 1);
  }

  void write(ExportFile& out, const ExportedStep& step) {
    out.text("** step '{}'\n*STEP, NLGEOM, INC=100000\n*STATIC\n{}, 1.\n", step.name,
             decimal(1. / step.increments));
    if (!step.displacements.empty()) out.text("*BOUNDARY\n");
    for (const auto& [of, values] : step.displacements) displacement(out, of.first, of.second + 1, values);
    if (!step.pressures.empty()) out.text("*DSLOAD\n");
    for (const auto& [surface, pressure] : step.pressures)
      out.text("{}, P, {}\n", names_.surfaces.of(surface), decimal(pressure));
    forces(out, step);
    for (const std::string& set : made_.printed)
      out.text("*NODE PRINT, NSET={}, TOTALS=YES\nU, RF\n", names_.sets.of(set));
    out.text("*NODE FILE\nU, RF\n*EL FILE\nS\n*END STEP\n");
  }

  void displacement(ExportFile& out, const std::string& set, int direction,
                    const std::vector<double>& values) const {
    if (values.size() == 1)
      return out.text("{}, {}, {}, {}\n", names_.sets.of(set), direction, direction, decimal(values[0]));
    const std::vector<int>& nodes = made_.sets.at(set);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      out.text("{}, {}, {}, {}\n", nodes[i] + 1, direction, direction, decimal(values[i]));
  }

  // Dead pressures and forces as one force per node. What a step does not mention stays in those programs, so
  // that a component that ends is written as 0.
  void forces(ExportFile& out, const ExportedStep& step) {
    if (step.dead.empty() && step.forces.empty() && loaded_.empty()) return;
    std::vector<double> X, force(3 * content_.mesh.points.size());
    for (const Point& p : content_.mesh.points) X.insert(X.end(), p.begin(), p.end());
    for (const auto& [surface, load] : step.dead) {
      const auto pattern = dead_pressure_pattern(X, content_.mesh.surfaces.at(surface), load.direction);
      for (std::size_t i = 0; i < force.size(); ++i) force[i] += load.pressure * pattern[i];
    }
    for (const auto& [set, on_each] : step.forces)
      for (int n : made_.sets.at(set))
        for (int c = 0; c < 3; ++c) force[3 * n + c] += on_each[c];
    for (std::size_t i = 0; i < force.size(); ++i)
      if (force[i] != 0) loaded_.insert(i);
    out.text("*CLOAD\n");
    for (std::size_t i : loaded_) out.text("{}, {}, {}\n", i / 3 + 1, i % 3 + 1, decimal(force[i]));
  }

  const ExportContent& content_;
  ExportedModel made_;
  InpMeshNames names_;
  std::set<std::size_t> loaded_;  // components of nodal forces up to the step that is written
};

}  // namespace

std::vector<std::string> write_inp(const std::string& path, const ExportContent& content) {
  return InpModel(content).write(path);
}

}  // namespace bulbus::inline app
