#include "app/cli/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "app/records/log_columns.hpp"
#include "app/scene/help.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/base/units.hpp"

namespace bulbus::inline app {
namespace {

std::string entry(const std::string& name, const std::string& about, const Terminal& to) {
  constexpr int about_at = 18;  // column
  const int taken = 2 + static_cast<int>(name.size());
  return "  " + bold(name, to) + std::string(std::max(2, about_at - taken), ' ') +
         wrapped(about, to.width ? std::max(to.width - about_at, 20) : 0, about_at) + "\n";
}

std::string first_clause(const std::string& text) {
  return text.substr(0, std::min({text.find(": "), text.find(". "), text.find(" ("), text.find(", but")}));
}

std::string heading_above(const std::string& text, const Terminal& to) {
  return "\n" + bold(wrapped(text, to.width), to) + "\n";
}

std::vector<std::string> all_names(const Parser& parser) {
  std::vector<std::string> names;
  for (const Topic& topic : topics()) names.push_back(topic.name);
  for (const CommandOutline& command : parser.commands()) names.push_back(command.name);
  for (const auto& keys : {scene_keys(), study_keys()})
    for (const KeyLine& k : keys) names.insert(names.end(), {k.key, plain_path(k.path)});
  return names;
}

// What stands behind "scene." and "study." is a path.
std::string path_of(const std::string& topic) {
  for (const char* root : {"scene.", "study."})
    if (topic.starts_with(root)) return topic.substr(6);
  return topic;
}

std::string key_or_word_help(const std::string& topic, Level most, const Terminal& to) {
  const std::string key = key_help(path_of(topic), most, to).value_or(""),
                    word = word_help(topic, to).value_or("");
  return key + (key.empty() || word.empty() ? "" : "\n") + word;
}

std::string units_help(const Terminal& to) {
  using Q = Quantity;
  std::string text = wrapped("A number without a unit is in the first of its line.", to.width) + "\n";
  for (const auto& [name, quantity] : {std::pair{"length", Q::length},
                                       {"area", Q::area},
                                       {"volume", Q::volume},
                                       {"force", Q::force},
                                       {"stress", Q::stress},
                                       {"angle", Q::angle}})
    text += entry(name, fmt::format("{}", fmt::join(units_of(quantity), ", ")), to);
  return text;
}

std::string log_help(const Terminal& to) {
  std::string text;
  for (const LogTable& table : log_tables()) {
    text += (text.empty() ? "" : "\n") + wrapped(table.of, to.width) + "\n";
    for (const LogColumn& column : table.columns) text += entry(column.name, column.meaning, to);
  }
  return text;
}

}  // namespace

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{{"scene", "every key of a scene file, for everyday use"},
                                      {"study", "every key of a study file"},
                                      {"units", "the units that a number may carry"},
                                      {"log", "the columns of the log of a run"}};
  return all;
}

std::string list_of_topics(const Parser& parser, const Terminal& to) {
  std::string text = "bulbus help TOPIC [--expert|--all]\n" + heading_above("Topics", to);
  for (const Topic& topic : topics()) text += entry(topic.name, topic.about, to);
  text += heading_above("Commands", to);
  for (const CommandOutline& command : parser.commands()) text += entry(command.name, command.about, to);
  text += heading_above(
      "Keys of a scene, and those below them: steps.increments, solver.linear, or gamma alone", to);
  for (const KeyLine& k : scene_keys())
    if (k.depth == 0) text += entry(k.key, first_clause(k.help), to);
  return text;
}

int print_topic(const Parser& parser, const Terminal& to, std::ostream& out, std::ostream& err) {
  const Arguments& given = parser.given();
  const std::string& topic = given.topic;
  const Level most = given.all ? Level::debug : given.expert ? Level::expert : Level::everyday;
  const auto commands = parser.commands();
  if (topic.empty()) {
    out << list_of_topics(parser, to);
  } else if (topic == "scene") {
    out << scene_help(most, to);
  } else if (topic == "study") {
    out << study_help(to);
  } else if (topic == "units") {
    out << units_help(to);
  } else if (topic == "log") {
    out << log_help(to);
  } else if (std::ranges::find(commands, topic, &CommandOutline::name) != commands.end()) {
    return Parser().parse({topic, "--help"}, to, out, err).value_or(0);
  } else if (const auto text = key_or_word_help(topic, most, to); !text.empty()) {
    out << text;
  } else {
    throw input_error("there is no topic '" + topic + "'",
                      did_you_mean(path_of(topic), all_names(parser), "'bulbus help' lists the topics"));
  }
  return 0;
}

}  // namespace bulbus::inline app
