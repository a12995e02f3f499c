#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/problem/model.hpp"

namespace bulbus {

/// c10 of a tissue of the eye, MPa, or nothing if no tissue has that name. `materials` is one of the choices
/// of Model::materials.
std::optional<double> tissue_stiffness(const std::string& materials, const std::string& tissue);

/// Gives every region that the model leaves out what its `materials` say.
void add_tissues(Model& model, const std::vector<std::string>& regions);

}  // namespace bulbus
