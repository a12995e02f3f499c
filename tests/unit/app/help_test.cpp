#include <nlohmann/json.hpp>
#include <sstream>

#include "app/scene/concepts.hpp"
#include "app/scene/help.hpp"
#include "app/scene/text_format.hpp"
#include "app/study/study.hpp"
#include "scenes.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

/// Calls `see` for every key below an object, into lists, maps and options.
template <class T, class See>
void walk_values(T& value, See&& see) {
  if constexpr (concepts::Described<T>) {
    value.describe([&](const char* key, auto& member, const About& about) {
      see(key, about);
      walk_values(member, see);
    });
  } else if constexpr (concepts::Map<T>) {
    typename T::mapped_type inner{};
    walk_values(inner, see);
  } else if constexpr (concepts::List<T> || concepts::Optional<T>) {
    typename T::value_type inner{};
    walk_values(inner, see);
  }
}

/// The number of keys.
template <class T>
int expect_every_key(const std::string& help) {
  T object;
  int keys = 0;
  walk_values(object, [&](const std::string& key, const About& about) {
    ++keys;
    const auto line = help.find(" " + key + " "), start = help.find("\n" + key + " ");
    EXPECT_TRUE(line != std::string::npos || start != std::string::npos) << key;
    EXPECT_NE(help.find(about.help), std::string::npos) << about.help;
    EXPECT_FALSE(about.help.empty()) << key;
  });
  return keys;
}

TEST(Help, MentionsEveryKeyWithItsLine) {
  EXPECT_GT(expect_every_key<Scene>(scene_help(Level::debug)), 100);
  EXPECT_GT(expect_every_key<Study>(study_help()), 10);
}

std::string line_of(const std::string& help, const std::string& start) {
  const auto at = help.find("\n" + start);
  return at == std::string::npos ? "" : help.substr(at + 1, help.find('\n', at + 1) - at - 1);
}

TEST(Help, TellsTypeUnitDefaultAndBounds) {
  const std::string help = scene_help(Level::expert);
  EXPECT_NE(line_of(help, "    gamma ")
                .find("number, default " + number_text(LinearSettings{}.gamma) + ", between 0 and 10000"),
            std::string::npos);
  EXPECT_NE(line_of(help, "  area ").find("number in mm2, default 0.001, above 0"), std::string::npos);
  EXPECT_NE(line_of(help, "    method ").find("(iterative or direct)"), std::string::npos);
  EXPECT_NE(line_of(help, "steps ").find("list of map, needed"), std::string::npos);
}

TEST(Help, ShowsTheDefaultsOfTheStructAroundNotOfTheMember) {
  EXPECT_NE(line_of(scene_help(), "      sclera ").find("map"), std::string::npos);
  EXPECT_NE(scene_help().find("default [0, 20, 60, 90, 105, 125, 151]"), std::string::npos);
}

TEST(Help, ExplainsAKeyByItsPathOrByItsName) {
  const std::string steps = key_help("steps").value(), increments = key_help("steps.increments").value();
  EXPECT_EQ(steps.substr(0, 6), "steps ");
  EXPECT_NE(steps.find("\n  increments "), std::string::npos);
  EXPECT_EQ(steps.find("regions "), std::string::npos);
  EXPECT_EQ(increments.substr(0, 21), "in steps:\nincrements ");
  const std::string named = key_help("increments").value();  // of a step, and of the stepping
  EXPECT_EQ(named.substr(0, increments.size() + 1), increments + "\n");
  EXPECT_NE(named.find("in solver.stepping:\nincrements "), std::string::npos);
  EXPECT_EQ(key_help("steps.0.increments").value(), increments);
  EXPECT_EQ(key_help("regions.NAME.c10").value(), key_help("regions.c10").value());
  EXPECT_EQ(key_help("vary").value().substr(0, 5), "vary ");  // of a study
  EXPECT_FALSE(key_help("nothing.of.the.kind").has_value());
}

TEST(Help, OfAKeyForExpertsIsShownToWhoAsksForIt) {
  EXPECT_NE(key_help("solver.linear.gamma").value().find("number, default "), std::string::npos);
  const std::string linear = key_help("solver.linear").value();
  EXPECT_EQ(linear.find("\n  gamma "), std::string::npos);
  EXPECT_NE(linear.find("'bulbus help solver.linear --expert' adds"), std::string::npos);
  EXPECT_NE(key_help("solver.linear", Level::expert).value().find("\n  gamma "), std::string::npos);
}

TEST(Help, KeepsToTheWidthOfATerminal) {
  for (const int width : {50, 80}) {
    std::istringstream in(scene_help(Level::debug, {width, false}));
    int longest = 0;
    for (std::string line; std::getline(in, line);) longest = std::max(longest, columns_of(line));
    EXPECT_LE(longest, width);
    EXPECT_GT(longest, width - 10);
  }
}

TEST(Help, StandsOutWhereThereIsColour) {
  EXPECT_EQ(key_help("title", Level::everyday, {80, true}).value().substr(0, 13), "\033[1mtitle\033[0m");
}

TEST(Schema, SaysTheSame) {
  const nlohmann::json schema = scene_schema(), &keys = schema["properties"];
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], (nlohmann::json{"mesh", "steps"}));
  const auto& gamma = keys["solver"]["properties"]["linear"]["properties"]["gamma"];
  EXPECT_EQ(gamma["type"], "number");
  EXPECT_EQ(gamma["minimum"], 0);
  EXPECT_EQ(gamma["maximum"], 10000);
  EXPECT_EQ(gamma["default"], LinearSettings{}.gamma);
  const auto& bar = keys["bars"]["additionalProperties"]["properties"];
  EXPECT_EQ(bar["E"]["type"], (nlohmann::json{"number", "string"}));  // "3 kPa"
  EXPECT_EQ(bar["E"]["exclusiveMinimum"], 0);
  EXPECT_EQ(keys["fix"]["items"]["properties"]["directions"]["default"], (nlohmann::json{"x", "y", "z"}));
  EXPECT_EQ(keys["symmetry"]["items"]["enum"], (nlohmann::json{"x", "y", "z"}));
  const auto& sources = keys["mesh"]["oneOf"];
  EXPECT_EQ(sources.size(), 6u);
  EXPECT_EQ(sources[0]["required"], (nlohmann::json{"file"}));
  EXPECT_EQ(keys["mesh"]["properties"]["sets"]["additionalProperties"]["type"],
            (nlohmann::json{"number", "string"}));
}

TEST(Schema, MarksTheLevelOfASetting) {
  const nlohmann::json schema = scene_schema();
  const auto described = [&](const char* key) {
    return schema["properties"]["solver"]["properties"]["linear"]["properties"][key]["description"]
        .get<std::string>();
  };
  EXPECT_TRUE(described("gamma").ends_with(" (expert)"));
  EXPECT_TRUE(described("dump").ends_with(" (debug)"));
  EXPECT_FALSE(described("method").ends_with(")"));
}

}  // namespace
