#include <gtest/gtest.h>

#include <algorithm>

#include "app/plot/chart.hpp"

namespace {

using namespace bulbus;

// Every element of the file is closed where it should be, and no text opens one.
void expect_well_formed(const std::string& svg) {
  std::vector<std::string> open;
  ASSERT_NE(svg.find("?>\n<svg"), std::string::npos) << svg.substr(0, 100);
  for (auto at = svg.find('<', svg.find("?>")); at != std::string::npos; at = svg.find('<', at + 1)) {
    const auto end = svg.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = svg.substr(at + 1, end - at - 1), name = tag.substr(0, tag.find(' '));
    EXPECT_EQ(std::count(tag.begin(), tag.end(), '"') % 2, 0) << tag;
    EXPECT_EQ(tag.find('<'), std::string::npos) << tag;
    if (tag[0] == '/') {
      ASSERT_FALSE(open.empty()) << tag;
      EXPECT_EQ("/" + open.back(), tag);
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Chart, IsWellFormedWhateverItShows) {
  Chart chart{.title = "a < b & \"c\"", .columns = 2};
  expect_well_formed(svg_of(chart));
  chart.panels = {{"<>", "&", {{1, "1"}, {2, "2"}}, {{"a<b", {{1, 5}, {2, 5, false}}}, {"b", {}}}},
                  {"far", "x", {{0, "only"}}, {{"a", {{0, 1}, {0, 1e6, false}, {0, -1e6, false}}}}},
                  {"none", "x", {{0, "only"}}, {{"a", {}}, {"b", {}}}},
                  {"one", "x", {{0, "only"}}, {{"a", {{0, 0}}}}}};
  const std::string svg = svg_of(chart);
  expect_well_formed(svg);
  EXPECT_NE(svg.find("a &lt; b &amp;"), std::string::npos);
  EXPECT_NE(svg.find("fill=\"white\" stroke=\"#0072b2\""), std::string::npos);
}

TEST(Chart, HasRoundTicks) {
  const auto texts = [](double low, double high) {
    std::vector<std::string> all;
    for (const auto& tick : round_ticks(low, high)) all.push_back(tick.text);
    return all;
  };
  EXPECT_EQ(texts(0, 1), (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(-3, 14), (std::vector<std::string>{"-5", "0", "5", "10", "15"}));
  EXPECT_EQ(texts(24.123, 24.131).front(), "24.122");
  EXPECT_GE(texts(7, 7).size(), 2u);
  EXPECT_GE(texts(0, 0).size(), 2u);
  EXPECT_GE(texts(0, 3e8).size(), 2u);
  EXPECT_LE(texts(0, 3e8).size(), 8u);
}

std::string texts_of(const std::vector<Chart::Tick>& ticks) {
  std::string all;
  for (const auto& tick : ticks) all += tick.text + ",";
  return all;
}

TEST(Chart, HasTicksOfDecades) {
  EXPECT_EQ(texts_of(log_ticks(5.3, 185)), "5,10,20,50,100,200,");
  EXPECT_EQ(texts_of(log_ticks(2, 10)), "2,5,10,");
  EXPECT_EQ(texts_of(log_ticks(.03, .03)), "0.02,0.05,");
  EXPECT_NEAR(log_ticks(5.3, 185).back().at, 2.30103, 1e-5);
  EXPECT_EQ(texts_of(percent_ticks(-1.9, -.1)), "1 %,10 %,100 %,");
  EXPECT_EQ(texts_of(percent_ticks(-7.6, -.2)), "1e-6 %,1e-4 %,0.01 %,1 %,100 %,");
  EXPECT_EQ(percent_ticks(-7.6, -.2).front().at, -8);
  EXPECT_EQ(texts_of(percent_ticks(-2, -2)), "1 %,10 %,");
}

TEST(Chart, NamesHollowMarksByAHollowOneWithoutALine) {
  Chart chart;
  chart.panels = {
      {"one", "x", {{0, "0"}, {1, "1"}}, {{"curve", {{0, 1}, {1, 2}}}, {"hollow", {{0, 1.5, false}}}}}};
  const std::string svg = svg_of(chart), named = svg.substr(0, svg.find(">hollow<"));
  const std::string of_hollow = named.substr(named.find(">curve<"));
  EXPECT_EQ(of_hollow.find("<line"), std::string::npos);
  EXPECT_NE(of_hollow.find("fill=\"white\" stroke=\"#d55e00\""), std::string::npos);
}

TEST(Chart, DrawsTheBackgroundGreyBelowTheCurves) {
  Chart chart;
  chart.panels = {
      {"one", "x", {{0, "0"}, {1, "1"}}, {{"curve", {{0, 1}, {1, 2}}}, {"all", {{0, 3}, {1, 2}}, true}}}};
  const std::string svg = svg_of(chart);
  expect_well_formed(svg);
  EXPECT_EQ(svg.find("<polyline"), svg.rfind("<polyline"));
  EXPECT_LT(svg.find("#b5b5b5", svg.find("font-weight=\"bold\">one")), svg.find("<polyline"));
}

}  // namespace
