// The tangent as it is applied on the fly against products with its stored matrix, on a deformed block of n³
// hexahedra.
#include <cmath>
#include <cstdio>

#include "benchmarks/common.hpp"
#include "benchmarks/machine.hpp"
#include "benchmarks/scalar_csr.hpp"
#include "core/element/block_csr.hpp"
#include "core/element/solid_tangent.hpp"
#include "core/mesh/generate/generate.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

// Operations of one hexahedron, a fused multiply-add counted as two, read off solid_kernel.hpp and q1.hpp:
// modes (3 × 34) and gradients (9 × 17) of two or three fields, b and what it gives (90 × 1.4, 18 × 2 × 2), 8
// points, the transpose (9 × 7 + 3 × 4, 3 × 31), the scatter (24).
constexpr double flops_gradient = 3 * 34 + 9 * 17, flops_volume = 2 * 63 + 2 * 36,
                 flops_transposed = 9 * 7 + 3 * 4 + 3 * 31, flops_scatter = 24;
constexpr double flops_kinematics = 27 + 5 + 45 + 4;    // cofactor, determinant, l det, 1/det and the weights
constexpr double flops_strain = 27 + 5 + 45 + 36 + 23;  // cofactor, determinant, F, b, J^(-2/3)
constexpr double flops_stress =
    7 + 3 + 45 + 30 + 54;  // neo-Hookean tangent: weighted b, (l − e I), product, the rest; flux
constexpr double flops_cache = 2 * flops_gradient + flops_volume + 8 * (flops_kinematics + flops_stress) +
                               flops_transposed + flops_scatter;
constexpr double flops_recompute = flops_cache + flops_gradient + 8 * flops_strain;
constexpr double flops_mean =
    2 * 3 * 34 + flops_volume + 2 * (2 * 63 + 18) + 2 * 216 + 12 + 3 * 31 + flops_scatter;

struct Case {
  Mesh mesh;
  std::vector<double> X, x, lambda, dx, dlambda;
};

Case deformed_block(int n) {
  Case c{generate(BlockShape{.nx = n, .ny = n, .nz = n}), {}, {}, {}, {}, {}};
  for (const Point& p : c.mesh.points) {
    const double a = .1 * std::sin(2 * p[1] + p[2]), b = .08 * std::cos(3 * p[0]), d = .05 * p[0] * p[1];
    for (double v : p) c.X.push_back(v);
    for (double v : {1.1 * p[0] + a, p[1] + b, .93 * p[2] + d}) c.x.push_back(v);
    for (double k : {3., 5., 7.}) c.dx.push_back(std::sin(k * (p[0] + 2 * p[1] + 3 * p[2])));
  }
  for (std::size_t e = 0; e < c.mesh.hexes.size(); ++e) {
    c.lambda.push_back(1e-3 * std::sin(.01 * e));
    c.dlambda.push_back(1e-3 * std::cos(.01 * e));
  }
  return c;
}

struct Variant {
  std::string name;
  double stored, traffic,
      flops;  // bytes, bytes read and written per application, operations per hexahedron (0: not counted)
  std::function<void(std::span<double>)> apply;
  std::vector<double> seconds;
  double difference = 0;
};

double distance(std::span<const double> a, std::span<const double> b) {
  double d = 0, s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d += std::pow(a[i] - b[i], 2), s += b[i] * b[i];
  return std::sqrt(d / s);
}

void measure(int n, const Options& o, double triad, double peak, json& rows) {
  const Case c = deformed_block(n);
  const int hexes = static_cast<int>(c.mesh.hexes.size()), nodes = static_cast<int>(c.mesh.points.size());
  const std::vector<SolidRegion> region{{"block", NeoHooke{.5}, 0, hexes}};
  const auto solid = std::make_shared<const Solid>(c.X, c.mesh.hexes, region);
  const auto x = std::make_shared<const std::vector<double>>(c.x),
             lambda = std::make_shared<const std::vector<double>>(c.lambda);
  const SolidTangent recompute(solid, x, lambda, 5, StrainSource::recompute),
      cache(solid, x, lambda, 5, StrainSource::cache), mean(solid, x, lambda, 5, StrainSource::recompute);
  const auto visit = [&](const ContributionVisitor& v) { recompute.visit(v, true); };
  const BlockCsr blocks(nodes, visit);
  const ScalarCsr scalar(nodes, visit);

  std::vector<NodeSingle> single_dx(nodes), single_y(nodes);
  for (int i = 0; i < nodes; ++i) single_dx[i] = rounded(&c.dx[3 * i]);
  mean.apply_single(single_dx, single_y);
  const double places = 3. * nodes * sizeof(double), vectors = 3 * places;  // dx read, force read and written
  std::vector<double> change(hexes);
  const double lean = solid->bytes() + recompute.bytes() + places + 8. * hexes;  // with x and λ
  std::vector<Variant> variants{{"recompute",
                                 lean,
                                 lean + vectors,
                                 flops_recompute,
                                 [&](std::span<double> y) { recompute.apply(c.dx, {}, y, change); },
                                 {}},
                                {"cache",
                                 lean + cache.cache_bytes(),
                                 lean - places + cache.cache_bytes() + vectors,
                                 flops_cache,
                                 [&](std::span<double> y) { cache.apply(c.dx, {}, y, change); },
                                 {}},
                                {"mean, single",
                                 1. * solid->bytes() + mean.bytes() + mean.cache_bytes(),
                                 mean.cache_bytes() + 32. * hexes + 4. * sizeof(NodeSingle) * nodes,
                                 flops_mean,
                                 [&](std::span<double>) { mean.apply_single(single_dx, single_y); },
                                 {}},
                                {"3x3 BCSR",
                                 1. * blocks.bytes(),
                                 blocks.bytes() + vectors,
                                 0,
                                 [&](std::span<double> y) { blocks.apply(c.dx, y); },
                                 {}},
                                {"CSR",
                                 1. * scalar.bytes(),
                                 scalar.bytes() + vectors,
                                 0,
                                 [&](std::span<double> y) { scalar.apply(c.dx, y); },
                                 {}}};
  std::vector<double> y(c.dx.size()), reference(c.dx.size());
  blocks.apply(c.dx, reference);
  for (int r = 0; r <= o.repetitions; ++r)  // taken in turns; the first round warms up
    for (Variant& v : variants) {
      std::fill(y.begin(), y.end(), 0.);
      std::ranges::fill(single_y, NodeSingle{});
      const double start = cpu_seconds();
      v.apply(y);
      const double seconds = cpu_seconds() - start;
      if (v.name == "mean, single")
        for (int i = 0; i < 3 * nodes; ++i) y[i] = single_y[i / 3][i % 3];
      if (r > 0)
        v.seconds.push_back(seconds);
      else
        v.difference = distance(y, reference);
    }
  const double baseline = median(variants[3].seconds);
  for (const Variant& v : variants) {
    const double s = median(v.seconds);
    json row{{"variant", v.name},
             {"n", n},
             {"hexahedra", hexes},
             {"unknowns", 3 * nodes + hexes},
             {"ns_per_hex", 1e9 * s / hexes},
             {"least_ns_per_hex", 1e9 * *std::ranges::min_element(v.seconds) / hexes},
             {"to_bcsr", s / baseline},
             {"stored_bytes_per_hex", v.stored / hexes},
             {"difference_to_bcsr", v.difference}};
    if (v.traffic > 0) row["gb_per_s"] = 1e-9 * v.traffic / s, row["of_triad"] = v.traffic / s / triad;
    if (v.flops > 0)
      row["gflops"] = 1e-9 * v.flops * hexes / s, row["of_fma_peak"] = v.flops * hexes / s / peak;
    rows.push_back(row);
  }
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  const Options o = parse(argc, argv, {60}, {8}, 15);
  json report = new_report("apply", o);
  const int megabytes = o.smoke ? 8 : 500;
  const double triad = triad_bandwidth(megabytes, o.smoke ? 1 : 9), peak = fma_peak(o.smoke ? 1 : 5);
  report["machine"] = {
      {"triad_gb_per_s", 1e-9 * triad}, {"triad_mb_per_array", megabytes}, {"fma_peak_gflops", 1e-9 * peak}};
  report["parameters"]["material"] = "neo-Hookean, augmented (gamma 5)";
  report["notes"] =
      "seconds are processor time, medians of turns; bytes of stored products: matrix, indices, dx read, "
      "force read "
      "and written; operations of the tangent counted by hand, one fused multiply-add as two";
  std::printf("triad %.1f GB/s, FMA peak %.1f GFLOP/s\n", 1e-9 * triad, 1e-9 * peak);
  for (int n : o.sizes) measure(n, o, triad, peak, report["rows"]);
  finish(report,
         {"variant", "hexahedra", "ns_per_hex", "to_bcsr", "stored_bytes_per_hex", "gb_per_s", "of_triad",
          "gflops", "of_fma_peak"},
         o);
}
