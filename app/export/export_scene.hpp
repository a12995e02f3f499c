#pragma once
#include <string>
#include <vector>

#include "app/export/exported_model.hpp"

namespace bulbus::inline app {

/// How a model is told.
struct ExportOptions {
  std::string element = "C3D8I";  ///< of Abaqus or CalculiX
  double bulk = 1000;             ///< bulk modulus in parts of each region's shear modulus
};

/// What a file is made of. All outlive the writing.
struct ExportContent {
  const std::string& heading;
  const Mesh& mesh;
  const Model& model;
  const ExportedModel& told;  ///< of this mesh and model
  const ExportOptions& options;
};

/// Writes an Abaqus or CalculiX input file, and returns what it leaves out: `left_out` of the model and of
/// the format. Throws std::runtime_error if it cannot be written. Not collective.
std::vector<std::string> write_inp(const std::string& path, const ExportContent& content);

/// The same as a FEBio file of version 4.0.
std::vector<std::string> write_feb(const std::string& path, const ExportContent& content);

}  // namespace bulbus::inline app
