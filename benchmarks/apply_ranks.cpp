// What sharing a mesh among ranks costs the tangent: its application with the exchange of nodes before and
// after, against the same parts applied by as many independent copies. A block of n × n × n hexahedra for
// each rank.
#include <algorithm>
#include <cmath>

#include "benchmarks/common.hpp"
#include "core/element/solid_tangent.hpp"
#include "core/mesh/distributed/local_mesh.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"

using namespace bulbus;
using namespace bulbus::bench;

namespace {

std::vector<SolidRegion> one_region(const LocalMesh& mesh) {
  return {{"block", NeoHooke{.5}, 0, static_cast<int>(mesh.hexes.size())}};
}

struct Part {
  LocalMesh mesh;
  std::vector<double> dx, force;
  SolidTangent tangent;
  Part(LocalMesh m, StrainSource source)
      : mesh(std::move(m)),
        dx(mesh.X),
        force(dx.size()),
        tangent(std::make_shared<const Solid>(mesh.X, mesh.hexes, one_region(mesh)), deformed(mesh.X),
                std::make_shared<const std::vector<double>>(mesh.hexes.size(), 1e-3), 5, source) {
    for (std::size_t i = 0; i < dx.size(); ++i) dx[i] = std::sin(7 * mesh.X[i]);
  }
  static SharedNumbers deformed(std::vector<double> x) {
    for (double& v : x) v += .05 * std::sin(3 * v);
    return std::make_shared<const std::vector<double>>(std::move(x));
  }
};

// Seconds of the slowest rank.
template <class Work>
double seconds(const Comm& comm, Work work) {
  comm.barrier();
  const double start = cpu_seconds();
  work();
  return comm.max(cpu_seconds() - start);
}

json measure(const std::string& name, Part& p, const Comm& comm, int repetitions) {
  std::vector<double> together, copies, exchanges;
  const auto exchange = [&] { p.mesh.halo.update_ghosts(p.dx), p.mesh.halo.accumulate_ghosts(p.force); };
  const auto apply = [&] { p.tangent.apply(p.dx, {}, p.force, {}); };
  const auto shared = [&] {
    p.mesh.halo.update_ghosts(p.dx), apply(), p.mesh.halo.accumulate_ghosts(p.force);
  };
  for (int r = 0; r <= repetitions; ++r) {  // taken in turns; the first round warms up
    const double t = seconds(comm, shared), c = seconds(comm, apply), e = seconds(comm, exchange);
    if (r > 0) together.push_back(t), copies.push_back(c), exchanges.push_back(e);
  }
  return {{"variant", name},
          {"hexahedra", p.mesh.all_hexes},
          {"ms", 1e3 * median(together)},
          {"copies_ms", 1e3 * median(copies)},
          {"exchange_ms", 1e3 * median(exchanges)},
          {"least_exchange_ms", 1e3 * *std::ranges::min_element(exchanges)},
          {"of_copies", median(copies) / median(together)},
          {"least_of_copies", *std::ranges::min_element(copies) / *std::ranges::min_element(together)}};
}

}  // namespace

int main(int argc, char** argv) {
  single_threaded(argv);
  Session session(argc, argv);
  const Comm comm;
  const Options o = parse(argc, argv, {60}, {8}, 25);
  json report = new_report("apply_ranks", o, comm.size());
  report["parameters"]["material"] = "neo-Hookean, augmented (gamma 5)";
  report["notes"] =
      "processor time of the slowest rank, waiting included, medians of turns; of_copies: throughput against "
      "independent copies";
  for (int n : o.sizes) {
    const Mesh mesh =
        generate(BlockShape{.upper = {1, 1, 1. * comm.size()}, .nx = n, .ny = n, .nz = n * comm.size()});
    const auto ranks = partition(mesh, comm.size());
    for (const auto& [name, source] :
         {std::pair{"recompute", StrainSource::recompute}, {"cache", StrainSource::cache}}) {
      Part part(distribute(mesh, ranks, comm), source);
      report["rows"].push_back(measure(name, part, comm, o.repetitions));
    }
  }
  if (comm.rank() == 0)
    finish(report, {"variant", "hexahedra", "ms", "copies_ms", "exchange_ms", "of_copies", "least_of_copies"},
           o);
}
