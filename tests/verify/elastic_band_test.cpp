// An elastic band around a ball: its tension is that of its own stretch, and balances the contact.
#include <cmath>
#include <numbers>

#include "contact/band_tension.hpp"
#include "tests/verify/contact_trial.hpp"

namespace bulbus {
namespace {

constexpr double turn = 2 * std::numbers::pi, radius = 12.5, shortened = 3;
// of six arcs in a quarter of a turn
const double lost_per_closing = turn * std::sin(turn / 48) / (turn / 48);

/// An eighth of a ball, or a quarter, within a band of the given stiffness that is shortened by 3 mm of its
/// circumference.
Scene ball(double stiffness, const std::string& part = "octant") {
  Scene scene{generate(BallShape{.radius = 12, .n = 2, .layers = 3, .part = part}), {}};
  Model& m = scene.model;
  m.regions["ball"] = neo_hooke(.05);
  m.symmetry = {"x", "y"};
  if (part == "octant")
    m.symmetry.push_back("z");
  else
    m.fix.push_back({"middle", {"z"}});
  scene.mesh.node_sets["middle"] = nodes_where(scene.mesh, [](const Point& p) { return norm(p) < 1e-9; });
  BandShape band{.radius = radius, .stiffness = stiffness};
  band.arc = {.from = 0, .to = 90, .parts = 6};
  m.rigid_bodies["band"].band = band;
  m.contacts.push_back(contact_between("band", "outer", "band"));
  m.contacts[0].divisions = 4;
  StepSpec s = step("shorten", 2);
  MoveSpec move;
  move.body = "band", move.from = "touch", move.shorten = shortened;
  s.move.push_back(move);
  m.steps = {step("start"), s, step("rest")};
  return scene;
}

struct Banded : ContactTrial {
  explicit Banded(double stiffness, const std::string& part = "octant")
      : ContactTrial(ball(stiffness, part)) {
    direct();
    EXPECT_TRUE(report.converged) << report.reason;
  }
  double tension() const {
    const auto& band = *interactions->bodies().at("band");
    const BandArcs arcs = band_arcs(problem, band, "band", "");
    return comm.sum(band_tension(band, arcs, contact("band").figures(state).on_master));
  }
  /// Of the mean radius, from where the band was drawn.
  double closed() const {
    const auto& band = *interactions->bodies().at("band");
    const auto& poses = interactions->motion("band").poses();
    double sum = 0;
    for (std::size_t p = 0; p < poses.size(); ++p)
      sum += dot(poses[p].shift, band.parts[p].inwards) / static_cast<double>(poses.size());
    return sum;
  }
};

TEST(ElasticBand, HasTheTensionOfItsStretch) {
  const Banded whole(0);
  const double touch = whole.closed() - shortened / lost_per_closing,
               C = turn * radius - lost_per_closing * touch;
  EXPECT_GT(whole.tension(), .1);
  for (double EA : {1., 10., 1e6}) {
    const Banded run(EA);
    const double way = run.closed() - touch, T = EA * (shortened - lost_per_closing * way) / (C - shortened);
    measured(
        "elastic band of {:g} N shortened by {:g} mm around a ball: closes by {:.4f} mm (without stretch "
        "{:.4f}), "
        "tension {:.4f} N, that of its stretch off by {:.1e}, Newton {}",
        EA, shortened, way, shortened / lost_per_closing, run.tension(), relative(T, run.tension()),
        run.report.newton_iterations);
    EXPECT_LT(relative(T, run.tension()), EA > 1e3 ? .1 : 2e-4) << EA;
    EXPECT_LT(way, shortened / lost_per_closing) << EA;
    EXPECT_LT(run.tension(), whole.tension() * (1 + 1e-6)) << EA;
    if (EA > 1e3) {
      EXPECT_LT(relative(run.tension(), whole.tension()), 1e-3);
    }
  }
}

// A plane normal to the axis halves its width.
TEST(ElasticBand, IsThatOfTheWholeInEveryPart) {
  const Banded eighth(10), quarter(10, "quarter");
  measured("elastic band of 10 N: tension {:.6f} N in an eighth of a ball, {:.6f} N in a quarter",
           eighth.tension(), quarter.tension());
  EXPECT_LT(relative(eighth.tension(), quarter.tension()), 1e-4);
  EXPECT_LT(relative(eighth.closed(), quarter.closed()), 1e-4);
}

TEST(ElasticBand, IsRefusedBeyondAPlaneOfSymmetry) {
  Scene scene = ball(10);
  scene.model.rigid_bodies["band"].band->arc.to = 180;
  EXPECT_THROW(ContactTrial{scene}, InputError);
}

}  // namespace
}  // namespace bulbus
