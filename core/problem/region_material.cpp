#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {

std::vector<Polynomial::Term> terms_of(const RegionSpec& spec) {
  std::vector<Polynomial::Term> terms;
  for (const Polynomial::Term& t : {Polynomial::Term{1, 0, spec.c10},
                                    {0, 1, spec.c01},
                                    {2, 0, spec.c20},
                                    {1, 1, spec.c11},
                                    {0, 2, spec.c02},
                                    {3, 0, spec.c30}})
    if (t.c != 0) terms.push_back(t);
  for (const auto& t : spec.terms) terms.push_back({t.r, t.s, t.c});
  return terms;
}

Material material_of(const RegionSpec& spec) { return make_material(terms_of(spec)); }

}  // namespace bulbus::inline problem
