#include "core/problem/probes/probe_record.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

ProbeSpec probe_since(const std::string& kind, const std::string& since,
                      const std::string& statistic = "mean") {
  ProbeSpec p;
  p.name = kind + " since " + since + " " + statistic;
  p.kind = kind, p.set = "xmax", p.to = "xmin", p.component = "y", p.since = since, p.statistic = statistic;
  return p;
}

Scene block(const std::vector<ProbeSpec>& probes) {
  Scene s{generate(BlockShape{.nx = 2, .ny = 2, .nz = 1}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"xmin", {"x", "y", "z"}});
  s.model.steps = {step("first"), step("second"), step("third")};
  s.model.probes = probes;
  return s;
}

/// A problem whose nodes are pushed in y by a function of their place.
struct Pushed {
  Problem problem;
  ProbeSet probes;
  ProbeRecord record{probes};
  explicit Pushed(const std::vector<ProbeSpec>& specs) : Pushed(block(specs)) {}
  explicit Pushed(const Scene& scene) : problem(scene.mesh, scene.model, Comm()), probes(problem) {}

  template <class Push>
  State state(Push push) const {
    State s = problem.initial_state();
    for (std::size_t n = 0; n < s.x.size(); n += 3) s.x[n + 1] += push(s.x[n], s.x[n + 1]);
    return s;
  }
  ProbeValues values(const State& state) const {
    Snapshot s(problem, state);
    return record.values(s);
  }
  void end(int step, const State& state) {
    Snapshot s(problem, state);
    record.step_ended(step, s);
  }
};

TEST(ProbeRecord, CountsFromTheEndOfAStep) {
  Pushed p({probe_since("distance", ""), probe_since("distance", "second")});
  const State one = p.state([](double x, double) { return -x; }),
              two = p.state([](double x, double) { return -3 * x; });
  p.end(0, one);
  auto v = p.values(one);
  EXPECT_NEAR(*v[0], 1, 1e-14);  // xmax is at x = 1
  EXPECT_FALSE(v[1]);
  p.end(1, one);
  v = p.values(one);
  EXPECT_EQ(v[1], 0.);
  p.end(2, two);
  v = p.values(two);
  EXPECT_NEAR(*v[0], 3, 1e-14);
  EXPECT_NEAR(*v[1], 2, 1e-14);
}

/// The largest change of a node is not the change of the largest.
TEST(ProbeRecord, DisplacementsCountNodeByNode) {
  Pushed p({probe_since("displacement", "first", "max"), probe_since("position", "first", "max")});
  p.end(0, p.state([](double, double y) { return y; }));
  const auto v = p.values(p.state([](double, double y) { return 1 - y; }));  // all at y = 1, up from 2 y
  EXPECT_NEAR(*v[0], 1, 1e-14);
  EXPECT_NEAR(*v[1], -1, 1e-14);
}

TEST(ProbeRecord, KeepsPeaks) {
  ProbeSpec all = probe_since("distance", ""), since = probe_since("distance", "first");
  all.peak = since.peak = true;
  Pushed p({all, since});
  const auto at = [&](double push) {
    const State s = p.state([=](double x, double) { return -push * x; });
    Snapshot snapshot(p.problem, s);
    return p.record.increment_ended(snapshot);
  };
  EXPECT_NEAR(*at(5)[0], 5, 1e-14);
  EXPECT_FALSE(at(1)[1]);
  p.end(0, p.state([](double x, double) { return -x; }));
  EXPECT_EQ(at(1)[1], 0.);
  EXPECT_NEAR(*at(3)[1], 2, 1e-14);
  const auto last = at(2);
  EXPECT_NEAR(*last[0], 5, 1e-14);
  EXPECT_NEAR(*last[1], 2, 1e-14);
}

TEST(ProbeRecord, ScalesAndNamesTheUnit) {
  ProbeSpec dioptres = probe_since("displacement", "first");
  dioptres.unit = "cm", dioptres.scale = -2.5, dioptres.label = "D";
  Pushed p({dioptres});
  EXPECT_EQ(p.probes.unit(0), "D");
  p.end(0, p.state([](double, double) { return .1; }));
  EXPECT_NEAR(*p.values(p.state([](double, double) { return .3; }))[0], -2.5 * .02, 1e-14);
}

TEST(ProbeRecord, RefusesAStepThatIsNotThere) {
  Scene scene = block({probe_since("displacement", "secnd")});
  try {
    Problem problem(scene.mesh, scene.model, Comm());
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "probes.0.since");
    EXPECT_NE(std::string(fault.what()).find("Did you mean 'second'?"), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace bulbus
