// The tangent as it is applied on the fly, law by law, on a deformed block of n³ hexahedra.
#include <cmath>
#include <functional>
#include <memory>

#include "benchmarks/common.hpp"
#include "core/element/solid_tangent.hpp"
#include "core/mesh/generate/generate.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

struct Law {
  std::string name;
  Material material;
  int families = 0;
};

std::vector<Law> laws() {
  const auto fibres = [](int families) {
    return Law{std::to_string(families) + " families of fibres", FibreReinforced{.5, .4, 1.5, .1, families},
               families};
  };
  return {{"neo-Hookean", NeoHooke{.5}},
          {"Fung-Demiray", Fung{1, 1.5}},
          fibres(1),
          fibres(2),
          fibres(3),
          {"Mooney-Rivlin", Isotropic<MooneyRivlin>{{.3, .2}}}};
}

// Some unit vectors.
std::vector<double> directions(int count) {
  std::vector<double> d;
  for (int i = 0; i < count; ++i) {
    const double a = .7 * i, b = std::sin(.3 * i);
    for (double v : {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)}) d.push_back(v);
  }
  return d;
}

void measure(int n, const Options& o, json& rows) {
  const Mesh mesh = generate(BlockShape{.nx = n, .ny = n, .nz = n});
  const int hexes = static_cast<int>(mesh.hexes.size());
  std::vector<double> X, x, dx, lambda(hexes);
  for (const Point& p : mesh.points) {
    const double a = .1 * std::sin(2 * p[1] + p[2]), b = .08 * std::cos(3 * p[0]), d = .05 * p[0] * p[1];
    X.insert(X.end(), p.begin(), p.end());
    for (double v : {1.1 * p[0] + a, p[1] + b, .93 * p[2] + d}) x.push_back(v);
    for (double k : {3., 5., 7.}) dx.push_back(std::sin(k * (p[0] + 2 * p[1] + 3 * p[2])));
  }
  struct Variant {
    std::string name;
    std::shared_ptr<const Solid> solid;
    SolidTangent tangent;
    std::vector<double> recompute = {}, residual = {};
  };
  const auto shared_x = std::make_shared<const std::vector<double>>(x),
             shared_lambda = std::make_shared<const std::vector<double>>(lambda);
  std::vector<Variant> variants;
  for (const Law& law : laws()) {
    const std::vector<SolidRegion> region{
        {"block", law.material, 0, hexes, directions(hexes * law.families)}};
    const auto solid = std::make_shared<const Solid>(X, mesh.hexes, region);
    variants.push_back(
        {law.name, solid, SolidTangent(solid, shared_x, shared_lambda, 5, StrainSource::recompute)});
  }
  std::vector<double> y(X.size()), change(hexes);
  const auto seconds = [](const auto& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
  };
  for (int r = 0; r <= o.repetitions; ++r)  // taken in turns; the first round warms up
    for (Variant& v : variants) {
      const double tangent = seconds([&] { v.tangent.apply(dx, {}, y, change); }),
                   residual = seconds([&] { v.solid->residual(x, lambda, y, change); });
      if (r > 0) v.recompute.push_back(tangent), v.residual.push_back(residual);
    }
  const double tangent = median(variants[0].recompute), residual = median(variants[0].residual);
  for (const Variant& v : variants)
    rows.push_back({{"law", v.name},
                    {"hexahedra", hexes},
                    {"ns_per_hex", 1e9 * median(v.recompute) / hexes},
                    {"to_neo_hookean", median(v.recompute) / tangent},
                    {"residual_to_neo_hookean", median(v.residual) / residual}});
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  const Options o = parse(argc, argv, {40}, {8}, 15);
  json report = new_report("laws", o);
  report["notes"] = "seconds are processor time, medians of turns; strain recomputed";
  for (int n : o.sizes) measure(n, o, report["rows"]);
  finish(report, {"law", "hexahedra", "ns_per_hex", "to_neo_hookean", "residual_to_neo_hookean"}, o);
}
