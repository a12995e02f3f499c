#include "app/study/study_source.hpp"

#include <fmt/format.h>

namespace bulbus::inline app {
namespace {

// A value that is put into the scene; `path` has numbers in place of names.
struct Given {
  std::string path, key;
  Place place;
};

struct Assigned {
  YamlNode root;
  std::vector<Given> set, overrides, varied;  // in their order
};

Place place_of_key(const Study& study, std::size_t factor, std::size_t key) {
  return place_of(study.source, fmt::format("vary.{}.keys.{}", factor, key));
}

// Result fields are off unless `set` wants them: a study is after its figures.
Assigned assigned(const Study& study, const Levels& levels) {
  Assigned a{study.scene_source, {}, {}, {}};
  set_at(a.root, "output.vtk", {}, YamlNode::word("false"));
  for (const auto& [key, value] : study.set)
    a.set.push_back({set_at(a.root, key, value.place, value), key, value.place});
  for (const std::string& assignment : study.overrides)
    a.overrides.push_back({apply_override(a.root, assignment), assignment, {"--set " + assignment, 0}});
  for (std::size_t f = 0; f < study.vary.size(); ++f)
    for (std::size_t k = 0; k < study.vary[f].keys.size(); ++k) {
      const std::string& key = study.vary[f].keys[k];
      const Place place = place_of_key(study, f, k);
      a.varied.push_back({set_at(a.root, key, place, study.vary[f].value(levels[f])), key, place});
    }
  return a;
}

bool holds(const std::string& path, const std::string& part) {
  return part == path || part.starts_with(path + ".");
}

void refuse(const Given& g, const std::string& what, const std::string& remedy) {
  throw input_error(g.place.file, g.place.line, what, remedy);
}

}  // namespace

YamlNode source_of(const Study& study, const Levels& levels) { return assigned(study, levels).root; }

void refuse_overwritten(const Study& study, const StudyRun& run) {
  const auto [root, set, overrides, varied] = of_run(study, run, [&] { return assigned(study, run.levels); });
  for (std::size_t b = 0; b < varied.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a)
      if (holds(varied[a].path, varied[b].path) || holds(varied[b].path, varied[a].path))
        refuse(varied[b],
               fmt::format("the key '{}' is varied twice: '{}' is the same, or a part of it", varied[b].key,
                           varied[a].key),
               "name it in one factor only");
    for (const Given& o : overrides)
      if (holds(varied[b].path, o.path))
        refuse(o, "the study varies this key", "leave --set out, or change `vary`");
    for (const Given& s : set)
      if (holds(varied[b].path, s.path))
        refuse(s, fmt::format("set: '{}' has no effect: the study varies '{}'", s.key, varied[b].key),
               "leave it out of `set`, or change `vary`");
  }
  for (std::size_t b = 0; b < set.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (holds(set[b].path, set[a].path))
        refuse(set[b], fmt::format("set: '{}' overwrites '{}'", set[b].key, set[a].key), "keep one of them");
}

}  // namespace bulbus::inline app
