#pragma once
#include "app/scene/yaml_node.hpp"
#include "tests/fuzz/random.hpp"

namespace bulbus::fuzz {

/// What mutants of scenes are made of besides their own parts: keys, words and branches of all scenes.
struct Pool {
  std::vector<std::string> keys;
  std::vector<YamlNode> branches;
  std::vector<std::pair<std::string, YamlNode>> values;  ///< of a key somewhere
  void add(const YamlNode& root);
};

/// One to four faults in the meaning of a scene: values replaced by awkward ones, of another kind or of
/// another key; keys dropped, given twice, renamed; branches exchanged, within the scene or with others;
/// entries of lists repeated, dropped or reversed.
YamlNode with_faults(YamlNode root, const Pool& pool, Random& random);

}  // namespace bulbus::fuzz
