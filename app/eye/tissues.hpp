#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/problem/model.hpp"

namespace bulbus::inline eye {

/// c10 of a tissue of the eye, MPa, or nothing if no tissue has that name. `materials` is one of the choices
/// of Scene::materials.
std::optional<double> tissue_stiffness(const std::string& materials, const std::string& tissue);

/// Gives every region that the model leaves out what `materials` say.
void add_tissues(const std::string& materials, const std::vector<std::string>& regions, Model& model);

/// Throws InputError where a region named after a tissue has no material: `materials` would give it one. A
/// model with a region that the mesh does not have is left to validate().
void require_tissues(const std::vector<std::string>& regions, const Model& model);

}  // namespace bulbus::inline eye
