#include "core/problem/probes/probes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/problem/probes/cancelled_figures.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

ProbeSpec probe(const std::string& kind, const std::string& set, const std::string& component = "magnitude",
                const std::string& statistic = "mean") {
  ProbeSpec p;
  p.name = kind + " " + set + " " + component + " " + statistic;
  p.kind = kind, p.set = set, p.component = component, p.statistic = statistic;
  return p;
}

ProbeSpec of_region(const std::string& kind, const std::string& statistic, double percentile = 100) {
  ProbeSpec p = probe(kind, "", "magnitude", statistic);
  p.percentile = percentile;
  return p;
}

ProbeSpec of_liquid(const std::string& kind, const std::string& unit) {
  ProbeSpec p = probe(kind, "");
  p.liquid = "fluid", p.unit = unit;
  return p;
}

/// The lower corner on the ground, the height 1; cells of equal size.
Scene block(Point lower, Point upper, int nx, int ny, int nz) {
  Scene s{generate(BlockShape{.lower = lower, .upper = upper, .nx = nx, .ny = ny, .nz = nz}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"xmin", {"x", "y", "z"}});
  s.model.steps = {step("one")};
  return s;
}

template <class Map>
State mapped(const Problem& p, Map map) {
  State s = p.initial_state();
  for (int n = 0; n < p.mesh().nodes(); ++n) {
    const Vec3<double> x = map(at(s.x, n));
    std::copy(x.begin(), x.end(), s.x.begin() + 3 * n);
  }
  return s;
}

std::vector<double> figures(Scene scene, const std::vector<ProbeSpec>& probes,
                            const std::function<void(Problem&, State&)>& set) {
  scene.model.probes = probes;
  Problem problem(scene.mesh, scene.model, Comm());
  State state = problem.initial_state();
  set(problem, state);
  return ProbeSet(problem).values(problem, state);
}

TEST(Probes, PlacesOfASet) {
  ProbeSpec apart = probe("distance", "xmin", "x"), length = probe("distance", "xmin");
  apart.to = length.to = "xmax";
  apart.unit = "um";
  const auto v = figures(
      block({0, 0, 0}, {2, 1, 3}, 2, 1, 1),
      {probe("displacement", "xmax", "x"), probe("displacement", "xmax", "y", "max"),
       probe("displacement", "xmax", "y", "min"), probe("position", "xmax", "magnitude", "max"),
       probe("position", "ymin", "radial", "min"), probe("displacement", "xmax", "radial", "max"), apart,
       length},
      [](Problem& p, State& s) {
        s = mapped(p, [](Vec3<double> X) { return Vec3<double>{1.5 * X[0], X[1] * (1 + X[0]), X[2]}; });
      });
  EXPECT_NEAR(v[0], 1, 1e-14);
  EXPECT_NEAR(v[1], 2, 1e-14);
  EXPECT_NEAR(v[2], 0, 1e-14);
  EXPECT_NEAR(v[3], std::sqrt(27), 1e-14);  // corner at (3, 3, 3)
  EXPECT_NEAR(v[4], 0, 1e-14);
  EXPECT_NEAR(v[5], std::sqrt(18) - std::sqrt(5), 1e-14);
  EXPECT_NEAR(v[6], 3000, 1e-10);
  EXPECT_NEAR(v[7], std::hypot(3, 1), 1e-14);  // the mean of y goes from 1/2 to 3/2
}

/// The plane y = 0 is pressed onto the z axis's meridian plane: the face x = 1 stands 1 inwards of x = 2.
TEST(Probes, HeightOfABuckle) {
  ProbeSpec height = probe("buckle_height", "xmin");
  height.to = "xmax";
  const auto v = figures(block({1, -1, 0}, {2, 1, 3}, 2, 2, 1), {height}, [](Problem& p, State& s) {
    s = mapped(p, [](Vec3<double> X) { return Vec3<double>{3 * X[0], 0, X[2]}; });
  });
  EXPECT_NEAR(v[0], 3, 1e-14);
}

/// Uniaxial stretch l of a neo-Hookean 2 × 1 × 3 block with c10 = 1/2: P = l − 1/l², Mises stress l P.
TEST(Probes, UniaxialStretch) {
  const double l = 1.4, P = l - 1 / (l * l);
  ProbeSpec newton = probe("reaction", "xmax", "x"), arm = probe("moment", "xmax", "y"),
            stress = of_region("mises", "mean");
  newton.unit = "mN", arm.unit = "mN mm", stress.unit = "kPa";
  const auto v =
      figures(block({0, 0, 0}, {2, 1, 3}, 2, 2, 2),
              {newton, arm, probe("moment", "xmax", "z"), probe("reaction", "xmax", "y"),
               probe("reaction", "xmin", "x"), stress, of_region("volume_ratio", "max"),
               of_region("volume_ratio", "min")},
              [&](Problem& p, State& s) {
                const double t = 1 / std::sqrt(l);
                s = mapped(p, [=](Vec3<double> X) { return Vec3<double>{l * X[0], t * X[1], t * X[2]}; });
                std::fill(s.lambda.begin(), s.lambda.end(), (l * l - 1 / l) / 3);
              });
  const double force = 3 * P, t = 1 / std::sqrt(l);
  EXPECT_NEAR(v[0], 1e3 * force, 1e-9);
  EXPECT_NEAR(v[1], 1e3 * force * 1.5 * t, 1e-9);  // M_y = z F_x
  EXPECT_NEAR(v[2], -force * .5 * t, 1e-12);
  EXPECT_NEAR(v[3], 0, 1e-12);
  EXPECT_NEAR(v[4], -force, 1e-12);
  EXPECT_NEAR(v[5], 1e3 * l * P, 1e-9);
  EXPECT_NEAR(v[6], 1, 1e-13);
  EXPECT_NEAR(v[7], 1, 1e-13);
}

/// A cut model reports what the whole one does.
TEST(Probes, SymmetryImagesMakeTheWhole) {
  std::vector<ProbeSpec> probes;
  for (const char* kind : {"reaction", "moment"})
    for (const char* c : {"x", "y", "z", "magnitude"}) probes.push_back(probe(kind, "xmax", c));
  probes.push_back(probe("reaction", "xmax", "radial"));
  for (const bool both : {false, true}) {
    const auto set = [=](Problem& p, State& s) {
      s = mapped(p, [=](Vec3<double> X) {
        const auto [x, y, z] = X;
        return Vec3<double>{x * (1.1 + .1 * y * y + .05 * z * z), y * (1 + .1 * x + .07 * z * z),
                            z * (.9 + .1 * y * y) + (both ? 0 : .2 * x + .1 * y * y)};
      });
    };
    const auto whole = figures(block({1, -1, -1}, {2, 1, 1}, 2, 2, 2), probes, set);
    Scene cut = block({1, 0, both ? 0. : -1.}, {2, 1, 1}, 2, 1, both ? 1 : 2);
    cut.model.symmetry = {"y"};
    if (both) cut.model.symmetry.push_back("z");
    const auto part = figures(cut, probes, set);
    EXPECT_GT(std::abs(whole[0]), .1);
    for (std::size_t i = 0; i < probes.size(); ++i)
      EXPECT_NEAR(part[i], whole[i], 1e-13) << both << ' ' << probes[i].name;
    EXPECT_EQ(std::abs(whole[5]) > .1, !both);  // M_y: kept by one plane, cancelled by two
  }
}

/// Each plane that does not cancel the component hides one half of its side.
TEST(Probes, WarningOfACancelledFigureNamesTheScaleThatMakesItsSideWhole) {
  Model model;
  const auto remedy_with = [&](const std::vector<std::string>& planes, const char* kind) {
    model.symmetry = planes;
    model.probes = {probe(kind, "xmax", "z")};
    const std::string sentence = cancelled_figures(model).at(0);
    return sentence.substr(sentence.find("; ") + 2);
  };
  const std::string part = "`of: part` gives that of the drawn part";
  EXPECT_EQ(remedy_with({"z"}, "reaction"), part);
  EXPECT_EQ(remedy_with({"x", "z"}, "reaction"),
            part + ", and with `scale: 2` that of its whole side of the plane");
  EXPECT_EQ(remedy_with({"x", "y", "z"}, "reaction"),
            part + ", and with `scale: 4` that of its whole side of the plane");
  EXPECT_EQ(remedy_with({"x", "z"}, "moment"),
            part + ", and with `scale: 2` that of its whole side of the plane");
}

/// Four equal cells, each with a stress of its own.
TEST(Probes, PercentilesCountVolume) {
  std::vector<ProbeSpec> probes;
  for (double percent : {0., 25., 50., 51., 99., 100.}) probes.push_back(of_region("mises", "mean", percent));
  std::vector<double> cells;
  const auto v = figures(block({0, 0, 0}, {4, 1, 1}, 4, 1, 1), probes, [&](Problem& p, State& s) {
    s = mapped(p, [](Vec3<double> X) { return Vec3<double>{X[0] + .05 * X[0] * X[0], X[1], X[2]}; });
    for (const CellStress& c : p.solid().stresses(s.x, s.lambda)) cells.push_back(c.mises);
    cells = p.comm().gather(std::span<const double>(cells));
  });
  std::sort(cells.begin(), cells.end());
  ASSERT_EQ(cells.size(), 4u);
  const int expected[] = {0, 0, 1, 2, 3, 3};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(v[i], cells[expected[i]]) << i;
}

/// Only the cells that touch the set: of four in a row, growing in stress, the last.
TEST(Probes, StressAroundASet) {
  ProbeSpec around = of_region("mises", "mean", 0);
  around.set = "xmax";
  const auto v = figures(
      block({0, 0, 0}, {4, 1, 1}, 4, 1, 1),
      {around, of_region("mises", "mean", 100), of_region("mises", "mean", 0)}, [&](Problem& p, State& s) {
        s = mapped(p, [](Vec3<double> X) { return Vec3<double>{X[0] + .05 * X[0] * X[0], X[1], X[2]}; });
      });
  EXPECT_EQ(v[0], v[1]);
  EXPECT_GT(v[0], 2 * v[2]);
}

TEST(Probes, RefuseKindsThatNobodyOffers) {
  Scene scene = block({0, 0, 0}, {1, 1, 1}, 2, 1, 1);
  scene.model.probes = {probe("gap", "xmax")};
  const Problem problem(scene.mesh, scene.model, Comm());
  try {
    const ProbeSet probes(problem);
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "probes.0.kind");
  }
  const ProbeSet::Kind seven{Quantity::length,
                             [](const Problem&, const ProbeSpec&) { return [](Snapshot&) { return 7.; }; }};
  EXPECT_EQ(ProbeSet(problem, {{"gap", seven}}).values(problem, problem.initial_state())[0], 7);
}

TEST(Probes, LiquidsAndBarsAreWhole) {
  ProbeSpec bars = of_region("bar_force", "max");
  bars.unit = "mN";
  Scene scene = filled_shell("octant");
  const auto v = figures(
      scene, {of_liquid("pressure", "mmHg"), of_liquid("volume", "uL"), bars, of_region("bar_force", "min")},
      [](Problem& p, State& s) {
        s = mapped(p, [](Vec3<double> X) { return Vec3<double>{1.1 * X[0], 1.1 * X[1], 1.1 * X[2]}; });
        s.P[0] = 15 * mmHg;
      });
  EXPECT_NEAR(v[0], 15, 1e-12);
  EXPECT_NEAR(v[1], 1.331 * 4. / 3 * std::numbers::pi * 8, 1.5);  // a facetted sphere
  const double force = 20 * .05 * (1.21 - 1) / 2 * 1.1;           // A E e |d|/L, whatever the share
  EXPECT_NEAR(v[2], 1e3 * force, 1e-10);
  EXPECT_NEAR(v[3], force, 1e-13);
}

// A bar on a plane of symmetry is half as often in the whole as one beside it.
TEST(Probes, MeanOfBarsCountsTheirShares) {
  Scene scene = block({0, 0, 0}, {1, 1, 1}, 1, 1, 1);
  const auto corner = [&](const Point& p) {
    return at_node(static_cast<int>(std::ranges::find(scene.mesh.points, p) - scene.mesh.points.begin()));
  };
  scene.mesh.bars["struts"] = {{corner({0, 0, 0}), corner({1, 0, 0}), .5},
                               {corner({0, 0, 0}), corner({0, 1, 0}), 1}};
  scene.model.bars["struts"] = {.E = 20, .area = .05};
  const auto v = figures(
      scene, {of_region("bar_force", "mean"), of_region("bar_force", "min"), of_region("bar_force", "max")},
      [](Problem& p, State& s) {
        s = mapped(p, [](Vec3<double> X) { return Vec3<double>{1.1 * X[0], 1.2 * X[1], X[2]}; });
      });
  const double first = 20 * .05 * (1.21 - 1) / 2 * 1.1,
               second = 20 * .05 * (1.44 - 1) / 2 * 1.2;  // A E e |d|/L
  EXPECT_NEAR(v[0], (.5 * first + second) / 1.5, 1e-13);
  EXPECT_NEAR(v[1], first, 1e-13);
  EXPECT_NEAR(v[2], second, 1e-13);
}

TEST(Probes, RefuseUnitsThatDoNotFit) {
  for (const auto& [kind, unit] :
       {std::pair{"reaction", "mm"}, {"position", "mmHg"}, {"moment", "N"}, {"volume_ratio", "mm"}}) {
    Scene scene = block({0, 0, 0}, {1, 1, 1}, 2, 1, 1);
    scene.model.probes = {probe("position", "xmax"), probe(kind, "xmax")};
    scene.model.probes[1].unit = unit;
    const Problem problem(scene.mesh, scene.model, Comm());
    try {
      const ProbeSet probes(problem);
      ADD_FAILURE() << kind << ' ' << unit;
    } catch (const InputError& fault) {
      EXPECT_EQ(fault.key, "probes.1.unit");
    }
  }
}

TEST(Probes, NameTheirUnits) {
  Scene scene = block({0, 0, 0}, {1, 1, 1}, 2, 1, 1);
  scene.model.probes = {probe("position", "xmax"), probe("moment", "xmax"), of_region("volume_ratio", "max")};
  scene.model.probes[0].unit = "cm";
  const Problem problem(scene.mesh, scene.model, Comm());
  const ProbeSet probes(problem);
  EXPECT_EQ(probes.unit(0), "cm");
  EXPECT_EQ(probes.unit(1), "N mm");
  EXPECT_EQ(probes.unit(2), "");
}

}  // namespace
}  // namespace bulbus
