#pragma once
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// What is prescribed at the end of a step, what earlier steps left included; lengths in mm, forces in N,
/// pressures in MPa.
struct ExportedStep {
  struct Dead {
    Point direction{};  ///< zero: against the reference normal
    double pressure = 0;
  };
  std::string name;
  int increments = 1;
  /// Displacement of a set in direction 0, 1 or 2: one for all nodes, or one for each.
  std::map<std::pair<std::string, int>, std::vector<double>> displacements;
  std::map<std::string, double> pressures;  ///< of surfaces, following them
  std::map<std::string, Dead> dead;         ///< of surfaces, per reference area
  std::map<std::string, Point> forces;      ///< on every node of a set
};

/// What of a model other programs can be told.
struct ExportedModel {
  struct Fixed {
    std::string set;
    std::array<bool, 3> directions{};
  };
  std::map<std::string, std::vector<int>> sets;  ///< of nodes, sorted: the mesh's and what the model names
  std::vector<Fixed> fixed;                      ///< symmetry planes included
  std::vector<ExportedStep> steps;
  std::set<std::string> printed;      ///< sets whose displacements and reactions are probes
  std::vector<std::string> left_out;  ///< sentences on what has no equivalent, or another meaning
};

/// Steps are taken up to the first that cannot be told: the later ones begin where it ends. Throws
/// InputError.
ExportedModel exported_model(const Model& model, const Mesh& mesh);

}  // namespace bulbus::inline app
