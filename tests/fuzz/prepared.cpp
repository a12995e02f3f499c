#include "tests/fuzz/prepared.hpp"

#include <algorithm>
#include <cmath>

#include "app/memory/memory_forecast.hpp"
#include "tests/fuzz/guard.hpp"

namespace bulbus::fuzz {
namespace {

void require_finite(std::span<const double> values, const std::string& what) {
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
    throw Silent("not finite: " + what);
}

void require_finite(const Prepared& prepared) {
  const Problem& problem = *prepared.problem;
  require_finite(problem.mesh().X, "places of nodes");
  for (const Liquid& l : problem.liquids())
    require_finite(std::array{l.volume(problem.mesh().X)}, "volume of liquid " + l.name());
  for (const auto& [name, body] : prepared.interactions->bodies()) {
    require_finite(body->places, "places of body " + name);
    for (const auto& corners : body->normals)
      for (const auto& n : corners) require_finite(n, "normals of body " + name);
  }
  for (const RegionQuality& q : prepared.quality)
    require_finite(std::array{q.volume, q.least, q.mean}, "quality of region " + q.region);
}

}  // namespace

Prepared prepare_checked(const YamlNode& root, const std::string& path) {
  try {
    Scene scene = scene_of(root, path);
    if (auto& limit = scene.solver.linear.memory_limit; sanitized && !limit) limit = 1e-6 * bytes_of_one;
    Prepared prepared = prepare(scene, Comm(MPI_COMM_SELF));
    refuse_what_cannot_fit(forecast_memory(prepared, scene), scene.solver.linear);
    require_finite(prepared);
    return prepared;
  } catch (const InputError& fault) {
    throw located(fault, root);
  }
}

}  // namespace bulbus::fuzz
