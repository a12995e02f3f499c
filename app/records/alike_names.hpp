#pragma once
#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// Result files and checkpoints do not hold every character that a name may have. Refuses two names of a kind
/// that would be one there. `model` with the laws of all regions. Throws InputError.
void refuse_names_alike_in_records(const Model& model);

}  // namespace bulbus::inline app
