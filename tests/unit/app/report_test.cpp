#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/records/record_names.hpp"
#include "app/report/html.hpp"
#include "app/report/model_json.hpp"
#include "app/report/pack.hpp"
#include "app/report/probe_words.hpp"
#include "app/report/report.hpp"
#include "app/report/sections.hpp"
#include "app/report/shown_states.hpp"
#include "app/report/thinning.hpp"
#include "core/io/vtp_read.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

/// Two hexahedra one above the other, each a region of its own, in two pieces if wanted.
SavedMesh stacked(int pieces) {
  SavedMesh mesh{{}, {}, {}, pieces};
  for (double z : {0., 1., 2.})
    for (const auto& [x, y] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
      mesh.points.push_back({x, y, z});
  mesh.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}};
  if (pieces == 2) {
    for (int n = 4; n < 8; ++n) mesh.points.push_back(mesh.points[n]);
    mesh.hexes[1] = {12, 13, 14, 15, 8, 9, 10, 11};
  }
  return mesh;
}

TEST(SolidSurface, HasTheFacesOfOneCellAndThoseBetweenRegions) {
  const std::vector<int> one{0, 0}, two{0, 1};
  EXPECT_EQ(whole_solid(stacked(1), one).faces.size(), 10U);
  const ShownSolid solid = whole_solid(stacked(1), two);
  EXPECT_EQ(solid.faces.size(), 12U);
  EXPECT_EQ(std::ranges::count(solid.faces, 0, &ShownFace::other), 1);
  EXPECT_EQ(std::ranges::count(solid.faces, 1, &ShownFace::other), 1);
}

/// Nodes of two ranks are one where they stay together, and two where they part.
TEST(SolidSurface, JoinsPiecesThatStayTogether) {
  const std::vector<int> one{0, 0};
  std::vector<double> displacement(3 * 16, 0.);
  SavedMesh together = stacked(2), apart = stacked(2);
  join_pieces(together, displacement, 3);
  EXPECT_EQ(whole_solid(together, one).faces.size(), 10U);
  for (int n = 12; n < 16; ++n) displacement[3 * n + 2] = .1;
  join_pieces(apart, displacement, 3);
  EXPECT_EQ(whole_solid(apart, one).faces.size(), 12U);
}

TEST(SolidSurface, KeepsWhatFacesShowAndJoinsNodesOfACube) {
  const SavedMesh mesh = stacked(1);
  const ShownSolid surface = surface_of(whole_solid(mesh, std::vector<int>{0, 1}));
  EXPECT_TRUE(surface.hexes.empty());
  EXPECT_EQ(surface.nodes.size(), 12U);
  EXPECT_EQ(surface.cells.size(), 2U);
  EXPECT_LT(clustered(surface, mesh.points, 1.6).nodes.size(), 12U);
  EXPECT_TRUE(clustered(surface, mesh.points, 100).faces.empty());
}

TEST(Pack, RoundsToTheNearestOfItsSteps) {
  const std::vector<float> values{1, 2, 1.5F, NAN, 7};
  const auto quanta = quantised(values, 1, 2);
  EXPECT_EQ(quanta, (std::vector<std::uint16_t>{0, quantum_top, quantum_top / 2, no_value, quantum_top}));
  EXPECT_EQ(quantised(std::vector<float>{3}, 3, 3)[0], 0);
}

TEST(Thinning, KeepsFirstLastAndEndsOfSteps) {
  RunRecord run;
  for (int i = 0; i <= 12; ++i) run.frames.push_back({i, i / 4., ""});
  EXPECT_EQ(chosen_frames(run, 100).size(), 13U);
  EXPECT_EQ(chosen_frames(run, 4), (std::vector<int>{0, 4, 8, 12}));
  EXPECT_EQ(chosen_frames(run, 2), (std::vector<int>{0, 12}));
  EXPECT_EQ(chosen_frames(run, 6).size(), 6U);
}

TEST(Html, EscapesWhatIsNoHtml) {
  EXPECT_EQ(html::text("p", "a < b & \"c\"", "note"), "<p class=\"note\">a &lt; b &amp; &quot;c&quot;</p>\n");
  EXPECT_EQ(html::unit("mm2") + html::unit("N mm"), "mm²N mm");
}

TEST(ProbeWords, SayWhatIsMeasured) {
  EXPECT_EQ(meaning_of({.kind = "gap", .set = "detached", .contact = "retina", .statistic = "max"}),
            "largest gap of the contact retina at detached");
  EXPECT_EQ(meaning_of({.kind = "mises", .region = "lens", .percentile = 99}),
            "Mises stress that 1 % of the volume exceed in lens");
  EXPECT_EQ(meaning_of({.kind = "reaction", .set = "xmax", .component = "x", .of = "part", .scale = 2}),
            "force of the supports on the body at xmax along x, of the drawn part alone, times 2");
  EXPECT_EQ(title_of("axial_change"), "Axial change");
}

TEST(ProbeWords, KnowEveryKind) {
  ProbeSpec p;
  std::vector<std::string> kinds;
  p.describe([&](const std::string& key, auto&, const About& about) {
    if (key == "kind") kinds = about.choices;
  });
  EXPECT_GT(kinds.size(), 20u);
  for (const std::string& kind : kinds) EXPECT_NE(meaning_of({.kind = kind}), kind);
}

// The page of a run that ended at the first probe's value.
std::string concluded(const ProbeSpec& probe, double value) {
  RunRecord run;
  run.summary = nlohmann::json::object();
  run.scene.emplace().model.probes = {probe};
  run.history.probes = {probe.name};
  run.history.ends.push_back({.step = "press", .values = {value}});
  return conclusions_of(run);
}

TEST(Conclusions, JudgeThePartOfTheNodesAndNotItsScaledRecord) {
  ProbeSpec p{.name = "hole", .kind = "closed_fraction", .contact = "retina", .tolerance = .3};
  p.scale = 100;
  const auto says = [&](double value, const char* words) {
    return concluded(p, value).find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(11, ">no<") && says(11, "11 % of"));
  EXPECT_TRUE(says(100, ">yes<") && says(100, "100 % of"));
  p.scale = .5;
  EXPECT_TRUE(says(.5, ">yes<"));
  p.scale = -1;
  EXPECT_FALSE(says(-1, ">yes<") || says(-1, ">no<"));
  p.scale = 1, p.since = "inflate";
  EXPECT_FALSE(says(1, ">yes<") || says(1, ">no<"));
  EXPECT_TRUE(says(1, "since the end of inflate"));
  p.since = "", p.peak = true;  // it may be open again
  EXPECT_FALSE(says(1, ">yes<") || says(1, ">no<"));
  EXPECT_TRUE(says(1, "largest so far"));
}

/// A suture over a tire, run once, with its page.
const Ran& suture() {
  static const Ran ran = [] {
    std::ifstream scene(BULBUS_DATA "/scenes/suture.yaml");
    const std::string text{std::istreambuf_iterator<char>(scene), {}};
    return call("run", fresh_folder("bulbus_report"), "scene.yaml", text, {"output.report=true"});
  }();
  return ran;
}

TEST(Report, HoldsTheModelOfTheRunWithinItsLimit) {
  ASSERT_EQ(suture().status, 0) << suture().err;
  EXPECT_TRUE(suture().wrote("report.html"));
  const RunRecord run = read_run((suture().folder / "out").string());
  const auto model = model_json(run, 1e9);
  EXPECT_EQ(model["frames"].size(), run.frames.size());
  EXPECT_TRUE(model["solid"].contains("hexes"));
  EXPECT_TRUE(model["notes"].empty());
  EXPECT_EQ(model["lines"]["names"][0], "suture string");
  const auto small = model_json(run, 1);
  EXPECT_FALSE(small["solid"].contains("hexes"));
  EXPECT_LT(small["solid"]["nodes"], model["solid"]["nodes"]);
  EXPECT_FALSE(small["notes"].empty());
}

TEST(Report, ReadsTheLinesThatWereWritten) {
  const auto folder = suture().folder / "out";
  const RunRecord run = read_run(folder.string());
  const SavedPolygons lines = read_vtp((folder / lines_file(run.frames.back().increment)).string());
  ASSERT_FALSE(lines.lines.empty());
  EXPECT_EQ(lines.field("force").size(), lines.lines.size());
  EXPECT_GT(lines.field("force")[0], 0);
  EXPECT_THROW(read_vtp((folder / "history.csv").string()), std::runtime_error);
}

TEST(Report, LeavesFilesOfOthersAlone) {
  const std::string folder = (suture().folder / "out").string();
  EXPECT_EQ(write_report(folder, "", ""), folder + "/report.html");
  std::ofstream(folder + "/comparison.html") << "mine";
  EXPECT_THROW(write_report(folder, folder, ""), InputError);
  EXPECT_EQ(write_report(folder, folder, folder + "/other.html"), folder + "/other.html");
}

TEST(Report, RefusesWhatIsNoFolderOfResults) {
  EXPECT_THROW(run_report(fresh_folder("bulbus_report_empty").string()), InputError);
}

}  // namespace
