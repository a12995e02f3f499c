#pragma once
#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// What a study varies: the value of one key of the scene, or of several at once.
struct Factor {
  std::string name, unit, baseline;
  std::vector<std::string> keys, labels;
  std::vector<YamlNode> values;
  template <class V>
  void describe(V&& v) {
    v("name", name, About{"name in the records"}.needed());
    v("keys", keys, About{"keys of the scene that all take the value"}.needed());
    v("values", values, About{"the values, of any kind that the keys take"}.needed());
    v("labels", labels, About{"what the records call the values, where numbers and words would not do"});
    v("baseline", baseline,
      About{"the value kept while other factors vary (one_at_a_time); empty: the first"});
    v("unit", unit,
      About{"unit of values that are numbers without one: [.5, 1] with unit mm are 0.5 mm and 1 mm"});
  }
  /// Throws InputError unless there are keys and different values, and unit, labels and baseline fit them.
  void validate() const;

  int levels() const { return static_cast<int>(values.size()); }
  int baseline_level() const;
  /// What the keys take: the value, with `unit` where it has none of its own.
  YamlNode value(int level) const;
  /// What the records call a level: its label, its number without unit, its text.
  std::string text(int level) const;
  /// The values, if all are numbers of one unit; else none.
  std::vector<double> numbers() const;
  /// The unit of these numbers; may be empty.
  std::string unit_text() const;
};

/// A study file: a scene, and what to vary in it.
struct Study {
  std::string title, scene, design = "product";
  std::map<std::string, YamlNode> set;
  std::vector<Factor> vary;
  std::vector<std::string> figures;
  double tolerance = 1e-5;
  template <class V>
  void describe(V&& v) {
    v("title", title, About{"a line for the records"});
    v("scene", scene, About{"scene file; a relative path counts from the folder of the study"}.needed());
    v("set", set, About{"keys of the scene that differ from its file in every run"});
    v("vary", vary, About{"factors; the first with numbers is the abscissa of the figure"}.needed());
    v("design", design,
      About{"every combination, or one factor at a time while the others keep their baseline"}.one_of(
          {"product", "one_at_a_time"}));
    v("figures", figures, About{"probes for table and figure; empty: all"});
    v("tolerance", tolerance,
      About{"a change below this part of a figure's largest value is none"}.between(0, 1));
  }
  /// Throws InputError if nothing varies, two factors share a name, or there are more runs than 10,000.
  void validate() const;
  long long combinations() const;

  YamlNode source;                     ///< the file as data
  YamlNode scene_source;               ///< the scene's file as data
  std::vector<std::string> overrides;  ///< path.to.key=value for every run, after `set`
};

/// The study as a group of values, as parameters_of(Scene&).
Value parameters_of(Study& study);

/// Reads a study file and that of its scene, of which no key is judged yet. `overrides` are for the scene.
/// Throws InputError.
Study read_study(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from the file as data; `path` gives the folder.
Study study_of(const YamlNode& source, const std::string& path,
               const std::vector<std::string>& overrides = {});

/// Whether a file is a study and not a scene. Throws InputError if it cannot be read.
bool is_study(const std::string& path);

}  // namespace bulbus::inline app
