// The compressed block against another code's values on the same mesh.
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

Scene compressed_block(int n, double pressure, int increments) {
  Scene scene{generate(BlockShape{.nx = n, .ny = n, .nz = n}), {}};
  scene.mesh.surfaces["pressed"] =
      faces_where(scene.mesh, scene.mesh.surfaces.at("ymax"),
                  [](const Point& p) { return p[0] < .5 + 1e-9 && p[2] < .5 + 1e-9; });
  scene.mesh.node_sets["corner"] = nodes_where(scene.mesh, [](const Point& p) {
    return norm(minus(p, Point{0, 1, 0})) < 1e-9;
  });
  Model& m = scene.model;
  m.regions["block"] = neo_hooke(80.194 / 2);
  m.symmetry = {"x", "y", "z"};
  m.fix.push_back({"ymax", {"x", "z"}});
  StepSpec s = step("press", increments);
  LoadSpec load;
  load.surface = "pressed", load.pressure = fmt::format("{:.17g}", pressure), load.dead = true,
  load.direction = {0, -1, 0};
  s.loads.push_back(load);
  m.steps.push_back(s);
  return scene;
}

TEST(CompressedBlock, HasTheDisplacementOfAnotherCode) {
  for (const auto& r : not_empty(references("compressed_block.csv"))) {
    const int n = static_cast<int>(std::lround(std::cbrt(r["hexes"])));
    if (n > 8) continue;
    const Scene scene = compressed_block(n, 4 * r["p_over_p0"], r["p_over_p0"] > 50 ? 8 : 4);
    Trial run(scene);
    run.direct();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    const double u = run.displacement(run.nodes(scene.mesh, "corner").at(0), 1),
                 error = relative(u, r["u_y"]);
    measured(
        "compressed block, p/p0 = {}, {} hexahedra: u_y = {:.9f}, reference {:.8f}, relative {:.1e} (target "
        "1e-7)",
        r["p_over_p0"], n * n * n, u, r["u_y"], error);
    EXPECT_LT(error, 1e-7);
  }
}

}  // namespace
}  // namespace bulbus
