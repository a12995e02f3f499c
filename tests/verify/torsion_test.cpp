// Torsion of a solid cylinder of fixed length: moment and axial force against the closed form.
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

constexpr double radius = 5, height = 4;

Scene twisted(int n, double twist) {
  Scene scene{generate(CylinderShape{.radius = radius, .height = height, .n = n, .rings = n, .layers = n}),
              {}};
  Model& m = scene.model;
  m.regions["cylinder"] = neo_hooke(.0833);
  m.fix.push_back({"bottom", {"x", "y", "z"}});
  StepSpec s = step("twist", twist > .15 ? 6 : twist > .05 ? 3 : 1);
  DisplaceSpec d = displace("top");
  d.rotate = DisplaceSpec::Rotation{.angle = twist * height};
  s.displace.push_back(d);
  m.steps.push_back(s);
  for (const char* kind : {"moment", "reaction"}) {
    ProbeSpec p;
    p.name = p.kind = kind, p.set = "top", p.component = "z";
    m.probes.push_back(p);
  }
  return scene;
}

struct Reactions {
  double moment, force;
};

Reactions reactions(int n, double twist) {
  Trial run(twisted(n, twist));
  run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  const auto values = ProbeSet(run.problem).values(run.problem, run.state);
  return {values[0], values[1]};
}

TEST(Torsion, MomentAndAxialForceConvergeWithSecondOrder) {
  const auto rows = references("torsion_cylinder.csv");
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& r : not_empty(rows)) {
    const double twist = r["twist_per_ref_length_rad_per_mm"];
    const Reactions coarse = reactions(4, twist), fine = reactions(8, twist);
    const double mc = relative(coarse.moment, r["Moment_Nmm"]), mf = relative(fine.moment, r["Moment_Nmm"]);
    const double nc = relative(coarse.force, r["Axial_force_N"]),
                 nf = relative(fine.force, r["Axial_force_N"]);
    measured(
        "torsion, {} rad/mm: moment off by {:.3f} % and {:.3f} % (order {:.2f}), axial force by {:.3f} % and "
        "{:.3f} % (order {:.2f})",
        twist, 100 * mc, 100 * mf, std::log2(mc / mf), 100 * nc, 100 * nf, std::log2(nc / nf));
    EXPECT_NEAR(std::log2(mc / mf), 2, .2);
    EXPECT_NEAR(std::log2(nc / nf), 2, .2);
  }
}

}  // namespace
}  // namespace bulbus
