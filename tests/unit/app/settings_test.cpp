// Levels of the solver's settings, and settings that have no effect.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/scene/help.hpp"
#include "app/scene/schema_tree.hpp"
#include "app/scene/unused.hpp"
#include "app/scene/value_of.hpp"
#include "app/study/study_design.hpp"
#include "scenes.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
using Kind = SchemaNode::Kind;
namespace fs = std::filesystem;

const std::string method_key = "solver.linear.method", displacement_key = "solver.linear.displacement";

/// Calls `see` for every key below a topic that holds a value, with its path.
template <class See>
void walk(const SchemaNode& topic, const std::string& path, See&& see) {
  for (const SchemaNode& t : topic.parts) {
    const std::string key = path + "." + t.key;
    if (t.kind == Kind::group)
      walk(t, key, see);
    else
      see(key, t);
  }
}

template <class See>
void walk_solver(See&& see) {
  SolverSettings defaults;
  walk(schema_tree_of("solver", About{""}, value_of(defaults)), "solver", see);
}

std::vector<std::string> keys_at(Level level) {
  std::vector<std::string> keys;
  walk_solver([&](const std::string& key, const SchemaNode& t) {
    if (t.about.level == level) keys.push_back(key);
  });
  return keys;
}

int count_in_scene(Level level) {
  Scene defaults;
  int count = 0;
  walk(schema_tree_of("", About{""}, parameters_of(defaults)), "",
       [&](const std::string&, const SchemaNode& t) { count += t.about.level == level; });
  return count;
}

/// A legal value that is not the default.
std::string another_value(const SchemaNode& t) {
  if (t.kind == Kind::truth) return t.fallback.text == "true" ? "false" : "true";
  if (t.kind == Kind::text)
    return t.about.choices.empty() ? "words" : t.about.choices[t.about.choices[0] == t.fallback.text];
  return std::isfinite(t.about.high) ? fmt::format("{}", t.about.high) : "7";
}

/// Assignments that make conditions hold up to the one numbered `but`, and the word that this one has then.
std::pair<std::vector<std::string>, std::string> choices(const std::vector<Condition>& conditions, int but) {
  std::vector<std::string> set{"mesh.refine=1"};  // multigrid needs it
  std::string chosen;
  for (int i = 0; i < static_cast<int>(conditions.size()); ++i) {
    const Condition& c = conditions[i];
    const std::string other = c.key == method_key         ? (c.words[0] == "direct" ? "iterative" : "direct")
                              : c.key == displacement_key ? "jacobi"
                                                          : "eigen";
    set.push_back(c.key + "=" + (i == but ? other : c.words[0]));
    if (i != but) continue;
    chosen = other;
    break;
  }
  return {set, chosen};
}

Scene least_with(const std::vector<std::string>& set) {
  return parse_scene(least_scene(), "scene.yaml", set);
}

TEST(Levels, AboutFifteenSettingsAreOfEveryDay) {
  const auto everyday = keys_at(Level::everyday);
  EXPECT_GE(everyday.size(), 12u);
  EXPECT_LE(everyday.size(), 16u);
  for (const char* key : {"solver.accuracy", "solver.linear.method", "solver.linear.memory_limit",
                          "solver.newton.force", "solver.stepping.increments"})
    EXPECT_NE(std::ranges::find(everyday, key), everyday.end()) << key;
  EXPECT_EQ(keys_at(Level::debug),
            (std::vector<std::string>{"solver.linear.dump", "solver.linear.record_krylov",
                                      "solver.linear.record_spectrum"}));
}

TEST(Levels, AreInheritedFromTheGroup) {
  const auto expert = keys_at(Level::expert);
  for (const char* key : {"solver.linear.multigrid.cycle", "solver.linear.pressures.after"})
    EXPECT_NE(std::ranges::find(expert, key), expert.end()) << key;
}

TEST(Levels, HelpShowsTheOthersOnRequest) {
  const std::string everyday = scene_help(), expert = scene_help(Level::expert),
                    all = scene_help(Level::debug);
  for (const std::string& help : {everyday, expert, all})
    EXPECT_NE(help.find("\n    memory_limit "), std::string::npos);
  EXPECT_EQ(everyday.find("smoothing_range"), std::string::npos);
  EXPECT_NE(expert.find("smoothing_range"), std::string::npos);
  EXPECT_EQ(expert.find("record_krylov"), std::string::npos);
  EXPECT_NE(all.find("record_krylov"), std::string::npos);
  const std::string left_out = fmt::format("{} settings for experts and {} for debugging are not shown",
                                           count_in_scene(Level::expert), count_in_scene(Level::debug));
  EXPECT_NE(everyday.find(left_out), std::string::npos) << everyday.substr(everyday.size() - 300);
  EXPECT_NE(expert.find("--all"), std::string::npos);
  EXPECT_EQ(all.find("--all"), std::string::npos);
}

TEST(Choices, AreReadFromTheirWordsAndWrittenAsThem) {
  walk_solver([](const std::string& key, const SchemaNode& t) {
    if (t.kind != Kind::text || t.about.choices.empty()) return;
    EXPECT_GE(t.about.choices.size(), 2u) << key;
    for (const std::string& word : t.about.choices) {
      std::vector<std::string> set = choices(t.about.conditions, -1).first;
      set.push_back(key + "=" + word);
      EXPECT_NE(resolved_yaml(least_with(set)).find(": " + word + "\n"), std::string::npos) << key << word;
    }
  });
}

TEST(Unused, IsRefusedForEveryConditionThatDoesNotHold) {
  int refused = 0;
  walk_solver([&](const std::string& key, const SchemaNode& t) {
    const std::string given = key + "=" + another_value(t);
    const auto& conditions = t.about.conditions;
    auto set = choices(conditions, -1).first;
    set.push_back(given);
    EXPECT_NO_THROW(least_with(set)) << given;
    for (int i = 0; i < static_cast<int>(conditions.size()); ++i) {
      auto [wrong, chosen] = choices(conditions, i);
      wrong.push_back(given);
      expect_error(least_scene(),
                   "--set " + given + ": " + key + ": has no effect: " + conditions[i].key + " is " + chosen,
                   "\n  Leave it out, or choose " + conditions[i].words[0], wrong);
      ++refused;
    }
  });
  EXPECT_GT(refused, 30);
}

TEST(Unused, IsToldWithFileAndLine) {
  expect_error(least_scene("solver:\n  linear:\n    method: direct\n    restart: 20\n"),
               "scene.yaml:7: solver.linear.restart: has no effect: solver.linear.method is direct\n",
               "Leave it out, or choose iterative for solver.linear.method.");
  expect_error(least_scene("solver:\n  linear:\n    degree: 4\n"),
               "scene.yaml:6: solver.linear.degree: has no effect: solver.linear.displacement is auto, here "
               "aggregation\n",
               "or choose hybrid");
}

TEST(Unused, AutoIsWhatTheMeshMakesOfIt) {
  const std::string aggregation = "solver.linear.aggregation.degree=8",
                    multigrid = "solver.linear.multigrid.degree=8";
  EXPECT_NO_THROW(least_with({aggregation}));
  EXPECT_NO_THROW(least_with({multigrid, "mesh.refine=1"}));
  expect_error(least_scene(), "--set " + multigrid, "auto, here aggregation", {multigrid});
  expect_error(least_scene(), "--set " + aggregation, "auto, here multigrid", {aggregation, "mesh.refine=1"});
}

// Presets and resolved.yaml give what the method does not use the values that it has anyway.
TEST(Unused, IsNotWhatHasItsDefault) {
  for (const char* accuracy : {"fast", "balanced", "tight"})
    for (const char* method : {"direct", "iterative"})
      for (const char* refine : {"0", "2"}) {
        const Scene scene = least_with({std::string("solver.accuracy=") + accuracy, method_key + "=" + method,
                                        std::string("mesh.refine=") + refine});
        const std::string text = resolved_yaml(scene);
        EXPECT_EQ(resolved_yaml(parse_scene(text, "resolved.yaml")), text);
      }
}

TEST(Unused, IsNothingInTheScenesOfTheProject) {
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(fs::path(BULBUS_DATA) / "scenes")) {
    if (file.path().extension() != ".yaml") continue;
    ++scenes;
    if (is_study(file.path())) {
      EXPECT_NO_THROW(plan(read_study(file.path()))) << file;
      continue;
    }
    for (const std::vector<std::string>& set : {std::vector<std::string>{},
                                                {method_key + "=direct"},
                                                {method_key + "=iterative"},
                                                {"solver.accuracy=fast"}})
      EXPECT_NO_THROW(read_scene(file.path(), set)) << file;
  }
  EXPECT_GT(scenes, 10);
}

TEST(Automatic, IsWrittenAsZero) {
  EXPECT_FALSE(least_with({"solver.linear.memory_limit=0"}).solver.linear.memory_limit);
  EXPECT_EQ(least_with({"solver.linear.memory_limit=7"}).solver.linear.memory_limit, 7);
  EXPECT_FALSE(least_with({"solver.linear.pressures.degree=0"}).solver.linear.pressures.degree);
  EXPECT_EQ(least_with({"solver.linear.pressures.degree=4"}).solver.linear.pressures.degree, 4);
  EXPECT_NE(resolved_yaml(least_with({})).find("\n    memory_limit: 0\n"), std::string::npos);
}

}  // namespace
