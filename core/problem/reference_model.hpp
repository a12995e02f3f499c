#pragma once
#include "core/base/error.hpp"
#include "core/problem/spec/reference_spec.hpp"

namespace bulbus::inline problem {

/// The model of one step that loads the unloaded mesh as it is drawn: without rigid bodies, contacts and
/// sutures. Throws InputError where the scene gives no load, an unknown liquid, or displacements of which
/// nobody can say whether they count from the drawn or from the unloaded positions.
Model reference_model(const Model& model, const ReferenceSpec& reference);

/// A fault of that model under the key that the scene has.
InputError in_reference(const InputError& fault);

}  // namespace bulbus::inline problem
