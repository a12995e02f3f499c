#pragma once
#include <string>
#include <vector>

#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Is a probe of this kind a sum of forces or moments, to which symmetry images add?
bool sums_forces(const std::string& kind);

/// A sentence for every probe whose figure the images in the planes of symmetry cancel, whatever happens.
std::vector<std::string> cancelled_figures(const Model& model);

}  // namespace bulbus::inline problem
