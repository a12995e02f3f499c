#pragma once
#include "core/material/material.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// All terms c_rs of a deformable region's energy; a pair of powers may come twice.
std::vector<Polynomial::Term> terms_of(const RegionSpec& spec);

/// The law that the keys of a deformable region choose: the only place that turns a RegionSpec into a
/// Material.
Material material_of(const RegionSpec& spec);

/// Throws InputError where keys of a region exclude one another; `key` is the region's.
void check_law(const RegionSpec& spec, const std::string& key);

}  // namespace bulbus::inline problem
