#include "app/study/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

#include "app/scene/reader.hpp"
#include "app/scene/value_of.hpp"

namespace bulbus::inline app {
namespace {

constexpr int most_runs = 10000;

std::string joined(const std::string& open, const std::vector<std::string>& parts, const std::string& close) {
  return open + fmt::format("{}", fmt::join(parts, ", ")) + close;
}

// In one line, as people would write it.
std::string flow_text(const YamlNode& e) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < e.items.size(); ++i)
    parts.push_back((e.is(YamlNode::Kind::map) ? e.keys[i] + ": " : "") + flow_text(e.items[i]));
  switch (e.kind) {
    case YamlNode::Kind::list:
      return joined("[", parts, "]");
    case YamlNode::Kind::map:
      return joined("{", parts, "}");
    default:
      return e.is(YamlNode::Kind::word) ? e.text : "null";
  }
}

struct Number {
  double value;
  std::string unit;
};

// "15 mmHg"; a formula such as "2*t" is no number.
std::optional<Number> number_of(const YamlNode& e) {
  if (!e.is(YamlNode::Kind::word) || e.text.empty() || !std::strchr("+-.0123456789", e.text[0])) return {};
  char* end = nullptr;
  const double value = std::strtod(e.text.c_str(), &end);
  const std::string rest = end;
  const auto unit = rest.find_first_not_of(' ');
  if (end == e.text.c_str() || !std::isfinite(value) ||
      rest.find_first_of("*/^()+-<>=?:,&|!") != std::string::npos)
    return {};
  return Number{value, unit == std::string::npos ? "" : rest.substr(unit)};
}

void refuse_factor(const std::string& name, const std::string& what, const std::string& remedy) {
  throw input_error("factor '" + name + "': " + what, remedy);
}

}  // namespace

void Factor::validate() const {
  if (keys.empty())
    refuse_factor(name, "has no keys",
                  "name at least one key of the scene, such as keys: [steps.0.increments]");
  if (values.empty()) refuse_factor(name, "has no values", "give at least one");
  if (!labels.empty() && labels.size() != values.size())
    refuse_factor(name, fmt::format("{} labels for {} values", labels.size(), values.size()),
                  "give one label for each value");
  for (const YamlNode& value : unit.empty() ? std::vector<YamlNode>{} : values)
    if (const auto n = number_of(value); !n || (!n->unit.empty() && n->unit != unit))
      refuse_factor(name, "the value " + flow_text(value) + " is no number in " + unit,
                    "leave `unit` out, or write the values as numbers in that unit");
  std::set<std::string> seen;
  for (int l = 0; l < levels(); ++l)
    if (!seen.insert(text(l)).second)
      refuse_factor(name, "the value " + text(l) + " is there twice", "keep one of the two");
  if (baseline_level() == levels())
    refuse_factor(name, "the baseline '" + baseline + "' is not among the values",
                  "write it as in `values` or `labels`");
}

int Factor::baseline_level() const {
  int level = 0;
  if (!baseline.empty())
    while (level < levels() && baseline != flow_text(values[level]) && baseline != text(level)) ++level;
  return level;
}

YamlNode Factor::value(int level) const {
  YamlNode value = values[level];
  if (!unit.empty() && number_of(value)->unit.empty()) value.text += " " + unit;
  return value;
}

std::string Factor::text(int level) const {
  if (!labels.empty()) return labels[level];
  const auto all = numbers();
  return all.empty() ? flow_text(values[level]) : fmt::format("{}", all[level]);
}

std::vector<double> Factor::numbers() const {
  std::vector<double> all;
  for (int l = 0; l < levels(); ++l) {
    const auto n = number_of(value(l));
    if (!n || n->unit != number_of(value(0))->unit) return {};
    all.push_back(n->value);
  }
  return all;
}

std::string Factor::unit_text() const { return numbers().empty() ? "" : number_of(value(0))->unit; }

long long Study::combinations() const {
  long long n = design == "product" ? 1 : 1 - static_cast<long long>(vary.size());
  for (const Factor& f : vary) n = design == "product" ? std::min(n * f.levels(), 1LL << 40) : n + f.levels();
  return n;
}

void Study::validate() const {
  if (vary.empty()) throw input_error("vary: no factors", "give at least one");
  std::set<std::string> names;
  for (const Factor& f : vary)
    if (!names.insert(f.name).second)
      throw input_error("two factors are named '" + f.name + "'", "give each its own name");
  if (combinations() > most_runs)
    throw input_error(fmt::format("more than {} runs", most_runs),
                      "take fewer values, or design: one_at_a_time");
}

Value parameters_of(Study& study) { return value_of(study); }

Study study_of(const YamlNode& source, const std::string& path, const std::vector<std::string>& overrides) {
  namespace fs = std::filesystem;
  Study study;
  study.source = source;
  study.overrides = overrides;
  reader::read(source, parameters_of(study));
  study.scene = (fs::path(path).parent_path() / study.scene).lexically_normal().string();
  if (!fs::is_regular_file(study.scene))
    reader::refuse(*source.find("scene"), "scene", "there is no file '" + study.scene + "'",
                   "a relative path counts from the folder of the study");
  study.scene_source = read_yaml(study.scene);
  return study;
}

Study read_study(const std::string& path, const std::vector<std::string>& overrides) {
  return study_of(read_yaml(path), path, overrides);
}

bool is_study(const std::string& path) {
  const YamlNode root = read_yaml(path);
  return root.find("vary") || root.find("scene");
}

}  // namespace bulbus::inline app
