#include "app/eye/tissues.hpp"

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"

namespace bulbus::inline eye {
namespace {

RegionSpec neo_hookean(double c10) {
  RegionSpec law;
  law.c10 = c10;
  return law;
}

RegionSpec fung(double a, double b) {
  RegionSpec law;
  law.fung = FungSpec{a, b};
  return law;
}

struct Tissue {
  const char* name;
  double paper;  // c10, MPa
  RegionSpec physiological;
};

// Stresses in MPa; c10 = E/6. Of `physiological`:
//
// - cornea: a quarter of the sclera's modulus, by which the eye keeps its image under pressure (Srodka and
//   Pierscionek, J. Biomedical Optics 13, 054013, 2008)
// - sclera: b is 2 c20/c10 of the law of Colmenarez et al. 2023 (c10 .91, c20 19.0), the same to second
//   order in Ī1 − 3; a makes the rigidity of the whole eye .0126 per µL between 10 and 35 mmHg (79 living
//   eyes; Pallikaris et al., IOVS 46, 409, 2005), by benchmarks/rigidity.py --fit regions.sclera.fung.a
// - choroid: E = .6 (Friberg and Lace, Exp. Eye Research 47, 429, 1988)
// - retina: E = .03, as in IOVS 61(4):3, 2020
// - ciliary body and optic nerve: six times the paper's, for want of measurements; lens: the paper's
const std::vector<Tissue>& tissues() {
  static const std::vector<Tissue> all{{"cornea", .0333, fung(.29, 42)},
                                       {"sclera", .0833, fung(1.17, 42)},
                                       {"ciliary_body", .01, neo_hookean(6 * .01)},
                                       {"choroid", .0083, neo_hookean(.1)},
                                       {"retina", .0008, neo_hookean(.005)},
                                       {"optic_nerve", .05, neo_hookean(6 * .05)},
                                       {"lens", 1, neo_hookean(1)}};
  return all;
}

constexpr double stiff_lens = 100;  // c10, MPa

}  // namespace

std::optional<RegionSpec> tissue_law(const std::string& materials, const std::string& tissue) {
  const auto found = std::ranges::find(tissues(), tissue, &Tissue::name);
  if (materials == "none" || found == tissues().end()) return {};
  if (materials == "physiological") return found->physiological;
  return neo_hookean(materials == "stiff_lens" && tissue == "lens" ? stiff_lens : found->paper);
}

void add_tissues(const std::string& materials, const std::vector<std::string>& regions, Model& model) {
  for (const std::string& name : regions)
    if (const auto law = tissue_law(materials, name); law && !model.regions.contains(name))
      model.regions[name] = *law;
}

void require_tissues(const std::vector<std::string>& regions, const Model& model) {
  const auto in_mesh = [&](const auto& region) { return std::ranges::count(regions, region.first) > 0; };
  if (!std::ranges::all_of(model.regions, in_mesh)) return;
  for (const std::string& name : regions)
    if (!model.regions.contains(name) && tissue_law("paper", name))
      throw scene_error("regions", "region '" + name + "' of the mesh has no material",
                        "Add `" + name + ": {c10: ...}` under `regions`, or say `materials: paper`.");
}

}  // namespace bulbus::inline eye
