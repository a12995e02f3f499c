#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "app/trade/trade_figure.hpp"
#include "app/trade/trade_records.hpp"
#include "core/io/text_file.hpp"
#include "tests/unit/app/studies.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

TEST(Extrapolation, FindsValueAndOrder) {
  const std::vector<double> h{2, 1.4, 1};
  for (double order : {.8, 1., 2., 3.3}) {
    std::vector<double> v;
    for (double size : h) v.push_back(5 - .3 * std::pow(size, order));
    const Extrapolated e = extrapolate(h, v);
    EXPECT_TRUE(e.observed);
    EXPECT_NEAR(e.order, order, 1e-9);
    EXPECT_NEAR(e.value, 5, 1e-9);
  }
}

TEST(Extrapolation, AssumesSecondOrderWhereNoneShows) {
  for (const std::vector<double>& v :
       std::vector<std::vector<double>>{{1, 3, 2}, {2, 2, 2.4}, {2, 2.4}, {1, 1, 1}}) {
    const std::vector<double> h{2, 1.5, 1};
    const Extrapolated e = extrapolate(std::span(h).last(v.size()), v);
    const double fine = v.back(), coarse = v[v.size() - 2];
    EXPECT_FALSE(e.observed);
    EXPECT_NEAR(e.value, fine + (fine - coarse) / (1.5 * 1.5 - 1), 1e-12);
  }
}

TEST(RelativeError, CountsFromTheLeastMagnitude) {
  EXPECT_NEAR(relative_error(1.02, 1, .5), .02, 1e-12);
  EXPECT_DOUBLE_EQ(relative_error(.01, 0, .5), .02);
  EXPECT_DOUBLE_EQ(relative_error(-3, -4, 0), .25);
  EXPECT_EQ(relative_error(0, 0, 0), 0);
  EXPECT_EQ(relative_error(1e-3, 0, 0), 1);
}

ProbeSpec probe(const std::string& kind, const std::string& unit, double scale = 1) {
  ProbeSpec p;
  p.kind = kind, p.unit = unit, p.scale = scale;
  return p;
}

TEST(RelativeError, KnowsWhatIsSmallInEveryUnit) {
  EXPECT_DOUBLE_EQ(least_of(probe("distance", "")), .5);
  EXPECT_DOUBLE_EQ(least_of(probe("distance", "um")), 500);
  EXPECT_DOUBLE_EQ(least_of(probe("distance", "", -2.7)), 1.35);
  EXPECT_NEAR(least_of(probe("pressure", "mmHg")), 5, 1e-4);
  EXPECT_DOUBLE_EQ(least_of(probe("closed_fraction", "")), 1);
  EXPECT_DOUBLE_EQ(least_of(probe("closed_fraction", "", 100)), 100);
  EXPECT_DOUBLE_EQ(least_of(probe("mises", "kPa")), 0);
}

TEST(Bargains, AreDominatedByWhatIsFasterAndNoLessAccurate) {
  const std::vector<ParetoCandidate> all{
      {1, 10, 1e-2}, {2, 20, 1e-2}, {3, 20, 1e-4}, {4, 20.5, 1e-4}, {5, 40, 1e-3}};
  EXPECT_EQ(better_than(all[0], all), nullptr);
  EXPECT_EQ(better_than(all[1], all)->run, 1);
  EXPECT_EQ(better_than(all[2], all), nullptr);
  EXPECT_EQ(better_than(all[3], all), nullptr);  // by less than noise
  EXPECT_EQ(better_than(all[4], all)->run, 3);
}

Trade bar_trade(const std::vector<std::string>& overrides = {}) {
  const std::string path = bar_folder() / "bar.yaml";
  return plan_trade(path, overrides, prepare(read_scene(path, overrides), Comm(MPI_COMM_SELF)));
}

TEST(TradePlan, RunsEverySceneOnce) {
  const Trade trade = bar_trade({"mesh.block.nx=4", "solver.linear.method=iterative"});
  std::set<std::string> scenes;
  for (const TradeRun& run : trade.runs)
    EXPECT_TRUE(scenes.insert(resolved_yaml(run.scene)).second) << run.parameter << " " << run.value;
  EXPECT_EQ(trade.runs[0].parameter, "reference");
  EXPECT_EQ(trade.runs[1].parameter, "scene");
  EXPECT_EQ(resolved_yaml(trade.runs[1].scene), resolved_yaml(read_scene(trade.scene, trade.runs[1].set)));
  EXPECT_EQ(trade.runs[0].scene.solver.newton.force, 1e-9);
  EXPECT_FALSE(trade.runs[0].scene.output.vtk);
  for (const char* parameter : {"eta_max", "newton", "gamma", "increments"})
    EXPECT_NE(std::ranges::find(trade.runs, parameter, &TradeRun::parameter), trade.runs.end()) << parameter;
}

// The bar is solved by MUMPS: there is nothing to learn from what GMRES does. Its reference is iterative.
TEST(TradePlan, LeavesOutWhatTheMethodDoesNotUse) {
  const Trade trade = bar_trade({"mesh.block.nx=4"});
  for (const char* parameter : {"gamma", "eta_max", "reuse", "degree"})
    EXPECT_EQ(std::ranges::find(trade.runs, parameter, &TradeRun::parameter), trade.runs.end()) << parameter;
  for (const TradeRun& run : trade.runs)
    EXPECT_EQ(resolved_yaml(read_scene(trade.scene, run.set)), resolved_yaml(run.scene)) << run.parameter;
}

TEST(TradePlan, CountsErrorsOfAMeshFromItsOwnTightSolution) {
  const Trade trade = bar_trade({"mesh.block.nx=4", "mesh.block.ny=4", "mesh.block.nz=4"});
  ASSERT_EQ(trade.meshes.size(), 3u);
  EXPECT_EQ(trade.meshes[0].reference, 0);
  EXPECT_EQ(trade.meshes[1].words, "nx 2, ny 2, nz 2");
  EXPECT_NEAR(trade.meshes[1].h.value(), 2, 1e-14);
  EXPECT_EQ(trade.meshes[2].words, "nx 6, ny 6, nz 6");
  for (int m : {1, 2}) {
    const TradeRun& tight = trade.runs[trade.meshes[m].reference];
    EXPECT_EQ(tight.mesh, m);
    EXPECT_EQ(tight.scene.solver.accuracy, Accuracy::tight);
  }
}

StudyRow row(double seconds, double value) {
  return {.converged = true, .values = {value}, .seconds = seconds};
}

TEST(TradePlan, LayersAWallWithoutExtrapolatingFromIt) {
  const std::string path = std::string(BULBUS_DATA) + "/scenes/encircling.yaml";
  const std::vector<std::string> coarse{"mesh.eye.n=8"};
  const Trade trade = plan_trade(path, coarse, prepare(read_scene(path, coarse), Comm(MPI_COMM_SELF)));
  const TradeMesh& layered = trade.meshes.back();
  EXPECT_EQ(layered.words, "layers 2");
  EXPECT_FALSE(layered.h);
  EXPECT_EQ(trade.runs[layered.reference].scene.mesh.eye->layers, 2);
  EXPECT_EQ(trade.runs[layered.reference].scene.mesh.eye->n, 8);

  TradeResults results;
  results.figures = {{"IOP", "mmHg"}};
  results.least = {0};
  for (const TradeRun& run : trade.runs) results.runs.push_back(run.name);
  results.rows.assign(trade.runs.size(), row(1, 20));
  extrapolate(trade, results);
  EXPECT_DOUBLE_EQ(results.extrapolated[0]->value, 20);
  results.rows[layered.reference] = row(1, 30);
  extrapolate(trade, results);
  EXPECT_DOUBLE_EQ(results.extrapolated[0]->value, 20);
  EXPECT_NEAR(whole_error(results, layered.reference)->value, .5, 1e-12);
}

// One cell across is one cell at any factor: no sequence of meshes that a figure could be extrapolated from.
TEST(TradePlan, ExtrapolatesFromNoMeshWhoseCountsDoNotAllChange) {
  const Trade trade = bar_trade({"mesh.block.nx=4", "mesh.block.ny=4"});
  ASSERT_EQ(trade.meshes.size(), 3u);
  for (int m : {1, 2}) {
    EXPECT_FALSE(trade.meshes[m].h) << m;
    EXPECT_EQ(trade.meshes[m].kept, "nz 1");
  }
  EXPECT_EQ(trade.meshes[1].words, "nx 2, ny 2");
  TradeResults results;
  results.figures = {{"pull", "mN"}};
  results.least = {0};
  for (const TradeRun& run : trade.runs) results.runs.push_back(run.name);
  results.rows.assign(trade.runs.size(), row(1, 20));
  results.megabytes.resize(trade.runs.size());
  extrapolate(trade, results);
  EXPECT_FALSE(results.extrapolated[0]);
  std::string text;
  for (const std::string& line : lines_of(trade, results)) text += line + "\n";
  EXPECT_NE(text.find("not extrapolated from nx 2, ny 2: nz 1 did not change"), std::string::npos) << text;
}

TEST(TradePlan, LeavesAMeshFromAFileAsItIs) {
  const std::string path = std::string(BULBUS_DATA) + "/scenes/two_blocks.yaml";
  const Trade trade = plan_trade(path, {}, prepare(read_scene(path), Comm(MPI_COMM_SELF)));
  ASSERT_EQ(trade.meshes.size(), 1u);
  EXPECT_EQ(trade.meshes[0].h, 1);
  EXPECT_EQ(trade.meshes[0].reference, 0);
}

TEST(TradeRecords, TellFrontAndDominated) {
  const Trade trade = bar_trade();
  TradeResults results;
  results.figures = {{"pull", "mN"}};
  results.least = {0};
  results.extrapolated.resize(1);
  for (const TradeRun& run : trade.runs) results.runs.push_back(run.name);
  results.rows.resize(trade.runs.size());
  results.megabytes.resize(trade.runs.size());
  results.rows[0] = row(9, 100);
  results.rows[1] = row(4, 100.001);
  results.rows[2] = row(1, 101);
  results.rows[3] = row(5, 100.1);
  std::string text;
  for (const std::string& line : lines_of(trade, results)) text += line + "\n";
  EXPECT_NE(text.find("1.0 s         1 %  accuracy fast"), std::string::npos) << text;
  EXPECT_NE(text.find("accuracy balanced (5.0 s, 0.1 %): scene accuracy tight takes 4.0 s, 0.001 %"),
            std::string::npos)
      << text;
  const std::string table = fresh_folder("bulbus_trade") / "trade.csv";
  write_trade_csv(table, trade, results);
  const TradePoints points = read_trade_points(table);
  ASSERT_EQ(points.on_mesh.size(), 3u);  // by rising seconds
  EXPECT_EQ(points.on_mesh[0].parameter + "," + points.on_mesh[1].parameter, "accuracy,scene");
  EXPECT_EQ(points.on_mesh[0].seconds, 1);
  EXPECT_NEAR(points.on_mesh[0].error, .01, 1e-12);
  EXPECT_TRUE(points.on_mesh[0].front && points.on_mesh[1].front);
  EXPECT_FALSE(points.on_mesh[2].front);
  EXPECT_TRUE(points.on_all.empty());
}

TEST(TradeFigure, HasTheFrontAndFourNamedParametersAtMost) {
  TradePoints points{{{"a", 1, 1e-1, true},
                      {"b", 2, 1e-2, true},
                      {"b", 3, 1e-3, true},
                      {"c", 4, 1e-4, true},
                      {"scene", 5, 1e-5, true},
                      {"idle", 6, 1e-1, false},
                      {"d", 7, 1e-6, true},
                      {"e", 8, 1e-7, true}},
                     {}};
  const Chart chart = chart_of(points);
  ASSERT_EQ(chart.panels.size(), 1u);
  const auto& series = chart.panels[0].series;
  std::string names;
  for (const auto& s : series) names += s.name + ",";
  EXPECT_EQ(names, "Pareto front,b,a,c,d,other settings,");
  EXPECT_EQ(series[0].marks.size(), 7u);
  EXPECT_EQ(series[1].marks.size(), 3u);  // the scene as it is among them
  EXPECT_EQ(series[5].marks.size(), 3u);
  EXPECT_TRUE(series[5].background);
  EXPECT_NEAR(series[0].marks[1].x, std::log10(2), 1e-12);
  EXPECT_NEAR(series[0].marks[1].y, -2, 1e-12);
}

TEST(TradeFigure, IsDrawnFromTheTableOfATrade) {
  const std::filesystem::path folder = fresh_folder("bulbus_trade");
  const std::string header =
      "run,parameter,value,seconds [s],error,front,extrapolated_error,extrapolated_front\n";
  const auto plot = [&](const std::string& rows, const std::vector<std::string>& more = {}) {
    std::ofstream(folder / "trade.csv") << header << rows;
    std::vector<std::string> arguments{"plot", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::ostringstream out, err;
    const int status = command_line(arguments, Comm(MPI_COMM_SELF), out, err);
    return std::to_string(status) + " " + out.str() + err.str();
  };
  const std::string row = "run_003,newton,\"1e-2, late\",4,.01,front,.2,front\n";
  EXPECT_EQ(plot(row), "0 " + (folder / "trade.svg").string() + "\n");
  EXPECT_NE(content_of(folder / "trade.svg").find(">newton<"), std::string::npos);
  EXPECT_NE(plot("run_003,newton,1e-2,soon,.01,front,,\n").find("trade.csv:2: 'soon' is no seconds [s]"),
            std::string::npos);
  EXPECT_EQ(plot("run_003,newton\n")[0], '2');
  EXPECT_EQ(plot(row, {"pull"})[0], '2');
}

TEST(Accuracy, IsOverriddenBySingleSettings) {
  const Scene scene = parse_scene(replaced(bar_scene, "solver:\n", "solver:\n  accuracy: fast\n"), "bar.yaml",
                                  {"solver.newton.force=1e-7"});
  EXPECT_EQ(scene.solver.newton.force, 1e-7);
  EXPECT_GT(scene.solver.newton.volume, NewtonSettings().volume);
  EXPECT_EQ(scene.solver.newton.max_iterations, 6);
  const Scene again = parse_scene(resolved_yaml(scene), "resolved.yaml");
  EXPECT_EQ(resolved_yaml(again), resolved_yaml(scene));
}

TEST(Accuracy, IsTightWhereNothingIsSaid) {
  const Scene said =
                  parse_scene(replaced(bar_scene, "solver:\n", "solver:\n  accuracy: tight\n"), "bar.yaml"),
              silent = parse_scene(bar_scene, "bar.yaml");
  EXPECT_EQ(resolved_yaml(said), resolved_yaml(silent));
}

}  // namespace
