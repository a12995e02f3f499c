#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {
namespace {

// All terms c_rs.
std::vector<Polynomial::Term> terms_of(const RegionSpec& s) {
  std::vector<Polynomial::Term> terms;
  for (const Polynomial::Term& t : {Polynomial::Term{1, 0, s.c10},
                                    {0, 1, s.c01},
                                    {2, 0, s.c20},
                                    {1, 1, s.c11},
                                    {0, 2, s.c02},
                                    {3, 0, s.c30}})
    if (t.c != 0) terms.push_back(t);
  for (const auto& t : s.terms) terms.push_back({t.r, t.s, t.c});
  return terms;
}

}  // namespace

Material material_of(const RegionSpec& spec) { return make_material(terms_of(spec)); }

}  // namespace bulbus::inline problem
