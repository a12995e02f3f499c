#pragma once
#include <map>
#include <utility>

#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// W = Σ c_rs (Ī1 − 3)^r (Ī2 − 3)^s, MPa.
struct ExportedMaterial {
  std::map<std::pair<int, int>, double> c;  ///< by r and s, none of them zero
  int order() const;                        ///< the largest r + s
  double coefficient(int r, int s) const;   ///< zero where there is none
  double shear() const;                     ///< initial shear modulus
};

/// Throws InputError for a region whose law `ExportedMaterial` cannot hold.
void refuse_unwritten_laws(const Model& model);

/// Of a deformable region whose law is a polynomial.
ExportedMaterial exported_material(const RegionSpec& spec);

}  // namespace bulbus::inline app
