// Scenes and studies: every shipped one and every case, as small as they get.
#include <algorithm>
#include <charconv>
#include <filesystem>

#include "app/study/study_design.hpp"
#include "core/base/error.hpp"
#include "tests/fuzz/bytes.hpp"
#include "tests/fuzz/prepared.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/tree.hpp"

namespace bulbus::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> yaml_files(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// Cells and facets that only cost time.
void shrink(YamlNode& at) {
  static const std::map<std::string, int> most{{"n", 6},      {"layers", 2}, {"nx", 3},
                                               {"ny", 2},     {"nz", 3},     {"rings", 2},
                                               {"refine", 0}, {"parts", 4},  {"divisions", 2}};
  for (std::size_t i = 0; i < at.items.size(); ++i) {
    YamlNode& item = at.items[i];
    if (at.is(YamlNode::Kind::map) && item.is(YamlNode::Kind::word))
      if (const auto limit = most.find(at.keys[i]); limit != most.end()) {
        int value = 0;
        std::from_chars(item.text.data(), item.text.data() + item.text.size(), value);
        item.text = std::to_string(std::min(value, limit->second));
      }
    shrink(item);
  }
}

bool is_prepared(const YamlNode& root, const std::string& path) {
  try {
    prepare_checked(root, path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

struct Seed {
  std::string path;
  YamlNode root;
};

// Faults in the bytes or in the tree of one of its seeds, with what the pool has of all of them.
class YamlTarget : public Target {
 public:
  std::string extension() const override { return ".yaml"; }

  Mutant make(Random& random) const override {
    const Seed& seed = random.of(seeds_);
    if (random.one_in(3)) return {seed.path, with_faults(to_yaml(seed.root), false, random)};
    return {seed.path, to_yaml(with_faults(seed.root, pool_, random))};
  }

 protected:
  std::vector<Seed> seeds_;
  Pool pool_;
};

class Scenes final : public YamlTarget {
 public:
  Scenes(const std::string& data, const std::string& cases) {
    for (const std::string& folder : {data + "/scenes", cases})
      for (const std::string& path : yaml_files(folder)) {
        if (is_study(path)) continue;
        YamlNode root = read_yaml(path);
        shrink(root);
        pool_.add(root);
        if (is_prepared(root, path)) seeds_.push_back({path, std::move(root)});
      }
  }
  std::string name() const override { return "scene"; }

  void judge(const Mutant& mutant) const override {
    prepare_checked(parse_yaml(mutant.content, mutant.seed), mutant.seed);
  }
};

class Studies final : public YamlTarget {
 public:
  explicit Studies(const std::string& data) {
    for (const std::string& path : yaml_files(data + "/scenes")) {
      YamlNode root = read_yaml(path);
      pool_.add(root);
      if (is_study(path)) seeds_.push_back({path, std::move(root)});
    }
  }
  std::string name() const override { return "study"; }

  // Its plan; preparing the scenes is what the other target does.
  void judge(const Mutant& mutant) const override {
    const Study study = study_of(parse_yaml(mutant.content, mutant.seed), mutant.seed, {});
    figures_of(study, plan(study));
  }
};

}  // namespace

std::unique_ptr<Target> scenes(const std::string& data, const std::string& cases) {
  return std::make_unique<Scenes>(data, cases);
}
std::unique_ptr<Target> studies(const std::string& data) { return std::make_unique<Studies>(data); }

}  // namespace bulbus::fuzz
