#include "app/scene/yaml_node.hpp"
#include "scenes.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

Scene resolved_input() { return parse_scene(full_scene, "/data/scene.yaml"); }

TEST(Resolved, ReadsBackAsTheSameScene) {
  const Scene before = resolved_input();
  const std::string text = resolved_yaml(before);
  const Scene after = parse_scene(text, "/elsewhere/resolved.yaml");
  EXPECT_EQ(resolved_yaml(after), text);
  EXPECT_EQ(after.title, before.title);
  EXPECT_EQ(after.mesh.block->upper, before.mesh.block->upper);
  EXPECT_EQ(after.model.regions.at("block").c10, before.model.regions.at("block").c10);  // bit by bit
  EXPECT_EQ(after.model.steps[0].pressures, before.model.steps[0].pressures);
  EXPECT_EQ(after.model.steps[1].displace[0].y, before.model.steps[1].displace[0].y);
  EXPECT_EQ(after.model.steps[1].displace[0].rotate->angle, before.model.steps[1].displace[0].rotate->angle);
  EXPECT_EQ(after.model.steps[1].displace[0].z.has_value(), false);
  EXPECT_EQ(after.solver.linear.op, TangentStorage::assembled);
}

TEST(Resolved, RoundTripHoldsForEveryMeshSource) {
  for (const char* source :
       {"file: a/b c.msh", "eye: {}", "block: {}", "shell: {}", "ball: {}", "cylinder: {}"}) {
    const std::string scene = std::string("mesh: {") + source + "}\nregions: {}\nsteps: []\n";
    const std::string text = resolved_yaml(parse_scene(scene, "/data/scene.yaml"));
    EXPECT_EQ(resolved_yaml(parse_scene(text, "/elsewhere/resolved.yaml")), text) << source;
  }
}

TEST(Resolved, WritesDefaultsOutWithTheirUnits) {
  const std::string text = resolved_yaml(resolved_input());
  EXPECT_NE(text.find("\n    K: 2083.3  # MPa\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n    max_iterations: 25\n"), std::string::npos);
  EXPECT_NE(text.find("\n    directions: [x, y, z]\n"), std::string::npos);
  EXPECT_NE(text.find("\n    force: 5.0e-07\n"), std::string::npos);
}

TEST(Yaml, KeepsTextThatLooksLikeSomethingElse) {
  for (const char* title : {"",
                            " ",
                            "null",
                            "~",
                            "# no comment",
                            "a: b",
                            "- x",
                            "\"q\" \\ 'q'",
                            "tab\tnew\nline",
                            "µm ²",
                            "[1, 2]",
                            "true",
                            "1.50",
                            "&a",
                            "*a",
                            "!t",
                            "%",
                            "-",
                            "...",
                            "a #b",
                            "\x01"}) {
    YamlNode map = YamlNode::empty(YamlNode::Kind::map);
    map.insert(*title ? title : "key", {}, YamlNode::word(title));
    const YamlNode read = parse_yaml(to_yaml(map), "text");
    ASSERT_EQ(read.items.size(), 1u) << title;
    EXPECT_TRUE(read.items[0].is(YamlNode::Kind::word)) << title;
    EXPECT_EQ(read.items[0].text, title);
    EXPECT_EQ(read.keys[0], map.keys[0]);
  }
}

TEST(Yaml, NestsListsInListsAndMapsInLists) {
  const std::string text = "a:\n  - b: 1\n    c: [2, [3]]\n  - d: {}\ne: []\n";
  EXPECT_EQ(to_yaml(parse_yaml(text, "text")), text);
  EXPECT_EQ(to_yaml(parse_yaml("a: [[{b: c}], [d]]", "text")), "a:\n  -\n    - b: c\n  - [d]\n");
}

}  // namespace
