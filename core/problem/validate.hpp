#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Refuses a model that does not fit its mesh: regions without material and materials without region, moduli
/// that are not positive, unknown or empty sets, surfaces, bars and liquids, liquids that leak, motions left
/// free. What holds of a mesh holds of its refinements. Throws InputError naming the key.
void validate(const Mesh& mesh, const Model& model);

/// Surfaces of the mesh of which every rank needs all nodes: those that take part in contact or are sutured.
/// Throws InputError for a contact whose surfaces do not exist, are empty or are the same.
std::set<std::string> shared_surfaces(const Mesh& mesh, const Model& model);

/// Refuses rigid motions that nothing prevents, of the whole or of a part, in the first step and, where there
/// are neither contacts nor sutures, in those that release something: fixed and prescribed directions,
/// symmetry planes and bars count. Throws InputError naming part and motion.
void require_supported(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
