// A thick sphere under inner pressure in hexahedra that are aligned with nothing
// (data/meshes/unstructured_shell.geo).
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

struct Found {
  double error;    // of the mean radial displacement inside
  int iterations;  // most Krylov iterations of a linear system, to 1e-6
};

Found inflated(const std::string& size, const ReferenceRow& r) {
  Scene scene{read_gmsh(BULBUS_DATA "/meshes/unstructured_shell_" + size + ".msh"), {}};
  Model& m = scene.model;
  m.regions["shell"] = neo_hooke(.0833);
  m.liquids["fluid"] = {.surface = "inner"};
  m.symmetry = {"x", "y", "z"};
  StepSpec s = step("inflate", 1);
  s.pressures["fluid"] = fmt::format("{:.17g}", r["p_MPa"]);
  m.steps.push_back(s);
  Trial run(scene);
  run.settings.newton = {.force = 1e-8, .volume = 1e-8, .eta_max = 1e-6};
  run.settings.linear.displacement = Displacement::aggregation;
  run.iterative();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  return {relative(run.mean_radial(scene.mesh, "inner"), r["u_r_inner_mm"]), most_krylov(run)};
}

TEST(UnstructuredSphere, TakesAsFewIterationsOnBothMeshes) {
  for (const auto& r : not_empty(references("thick_sphere_inflation_given_pressure.csv"))) {
    if (r["p_MPa"] != .005) continue;
    const Found coarse = inflated("coarse", r), fine = inflated("fine", r);
    measured(
        "unstructured thick sphere, p = {}: inner u_r off by {:.3f} % (1168 hexahedra) and {:.3f} % (3140); "
        "at most {} and {} iterations",
        r["p_MPa"], 100 * coarse.error, 100 * fine.error, coarse.iterations, fine.iterations);
    EXPECT_LT(coarse.error, .01);
    EXPECT_LT(fine.error, coarse.error);
    EXPECT_LE(coarse.iterations, 25);
    EXPECT_LE(fine.iterations, 25);
  }
}

}  // namespace
}  // namespace bulbus
