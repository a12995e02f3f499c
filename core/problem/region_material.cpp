#include "core/problem/region_material.hpp"

#include "core/base/error.hpp"

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

Material material_of(const RegionSpec& spec) {
  if (spec.fung) return Fung{spec.fung->a, spec.fung->b};
  if (const auto& f = spec.fibres)
    return FibreReinforced{spec.c10, f->k1, f->k2, f->dispersion, static_cast<int>(f->families.size())};
  return make_material(terms_of(spec));
}

void check_law(const RegionSpec& spec, const std::string& key) {
  const bool further = spec.c01 != 0 || spec.c20 != 0 || spec.c11 != 0 || spec.c02 != 0 || spec.c30 != 0 ||
                       !spec.terms.empty();
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw scene_error(key, what, remedy);
  };
  if (spec.rigid && (spec.fung || spec.fibres))
    refuse("a rigid region has no law", "Leave `rigid`, or `fung` and `fibres`, out.");
  if (spec.fung && (spec.fibres || spec.c10 != 0 || further))
    refuse("`fung` is the whole law of a region",
           "Leave the other coefficients out: `fung: {a: ...}` is its initial shear modulus.");
  if (spec.fibres && further)
    refuse("`fibres` stand beside c10 alone", "Leave the other coefficients of the region out.");
}

}  // namespace bulbus::inline problem
