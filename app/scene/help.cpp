#include "app/scene/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/base/characters.hpp"

namespace bulbus::inline app {
namespace {

using Keys = std::vector<KeyLine>;

constexpr int facts_at = 24, help_at = 6;  // columns

// Without a terminal one line for each, which can be searched; with one, help in lines of its own.
std::string text_of(const KeyLine& k, int depth, const Terminal& to) {
  const std::string indent(2 * depth, ' ');
  if (to.width == 0) return fmt::format("{:<22}  {:<40}  {}\n", indent + k.key, k.facts, k.help);
  const int taken = static_cast<int>(indent.size() + k.key.size());
  const int below = static_cast<int>(indent.size()) + help_at;
  return indent + bold(k.key, to) + std::string(std::max(2, facts_at - taken), ' ') +
         wrapped(k.facts, to.width - std::max(taken + 2, facts_at), facts_at) + "\n" +
         std::string(below, ' ') + wrapped(k.help, to.width - below, below) + "\n";
}

// How many keys there are of it and below it.
std::size_t size_with_keys_below(const Keys& keys, std::size_t first) {
  std::size_t end = first + 1;
  while (end < keys.size() && keys[end].depth > keys[first].depth) ++end;
  return end - first;
}

std::string texts_of(std::span<const KeyLine> keys, Level most, const Terminal& to) {
  std::string text;
  for (const KeyLine& k : keys)
    if (k.level <= most) text += text_of(k, k.depth - keys[0].depth, to);
  return text;
}

std::string what_is_left_out(std::span<const KeyLine> keys, Level most, const std::string& topic) {
  const auto count = [&](Level level) {
    return std::ranges::count_if(keys, [&](const KeyLine& k) { return !k.group && k.level == level; });
  };
  const auto expert = most < Level::expert ? count(Level::expert) : 0,
             debug = most < Level::debug ? count(Level::debug) : 0;
  const std::string command = "'bulbus help " + topic;
  if (expert > 0 && debug > 0)
    return fmt::format(
        "{} settings for experts and {} for debugging are not shown: {} --expert' adds the former, '--all' "
        "both.",
        expert, debug, command);
  if (expert > 0)
    return fmt::format("{} settings for experts are not shown: {} --expert' adds them.", expert, command);
  return debug > 0
             ? fmt::format("{} settings for debugging are not shown: {} --all' adds them.", debug, command)
             : "";
}

std::string paragraph(const std::string& text, const Terminal& to) {
  return text.empty() ? "" : wrapped(text, to.width ? to.width : 110) + "\n";
}

// The path of the key that it is below; empty at the root.
std::string path_around(const KeyLine& k) {
  const std::string plain = plain_path(k.path);
  const auto end = plain.rfind('.');
  return end == std::string::npos ? "" : plain.substr(0, end);
}

// Keys of that path; or, where there is none, of that name.
std::vector<std::size_t> found(const Keys& keys, const std::string& path) {
  std::vector<std::size_t> by_path, by_name;
  const std::string plain = plain_path(path);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (plain_path(keys[i].path) == plain) by_path.push_back(i);
    if (keys[i].key == path) by_name.push_back(i);
  }
  return by_path.empty() ? by_name : by_path;
}

std::string help_on(const Keys& keys, const std::string& path, Level most, const Terminal& to) {
  std::string text;
  for (const std::size_t i : found(keys, path)) {
    const auto shown = std::span(keys).subspan(i, size_with_keys_below(keys, i));
    const Level level = std::max(most, keys[i].level);  // who asks for it sees it
    const std::string plain = plain_path(keys[i].path), around = path_around(keys[i]);
    if (!text.empty()) text += "\n";
    if (!around.empty()) text += "in " + bold(around, to) + ":\n";
    text += texts_of(shown, level, to);
    if (const std::string left = what_is_left_out(shown, level, plain); !left.empty())
      text += "\n" + paragraph(left, to);
  }
  return text;
}

bool mentions(const std::string& text, const std::string& word) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_word(text[at - 1])) && (end == text.size() || !is_word(text[end]))) return true;
  }
  return false;
}

// Where a key may have this word as its value, and the keys beside it that speak of the word.
std::string uses_of(const Keys& keys, const std::string& word, const Terminal& to) {
  std::string text;
  for (const KeyLine& k : keys) {
    if (std::ranges::find(k.words, word) == k.words.end()) continue;
    text += (text.empty() ? "" : "\n") +
            paragraph(fmt::format("'{}' is a value of {}: {}", word, plain_path(k.path), k.about), to);
    std::string beside;
    for (const KeyLine& other : keys)
      if (&other != &k && path_around(other) == path_around(k) && mentions(other.help, word))
        beside += text_of(other, 1, to);
    if (!beside.empty()) text += "keys beside it that say more:\n" + beside;
  }
  return text;
}

}  // namespace

std::string scene_help(Level most, const Terminal& to) {
  const Keys keys = scene_keys();
  const std::string left = what_is_left_out(keys, most, "scene");
  return paragraph(
             "A scene is a YAML file. Lengths in mm, forces in N, stresses in MPa, angles in rad; a value "
             "may carry its own unit (15 mmHg). A formula may use X, Y, Z (mm), s (0 to 1 over the step) and "
             "t (steps done + s).",
             to) +
         "\n" + texts_of(keys, most, to) + (left.empty() ? "" : "\n" + paragraph(left, to));
}

std::string study_help(const Terminal& to) {
  return paragraph(
             "A study is a YAML file: a scene, and what to vary in it. Keys of the scene are paths such as "
             "steps.1.increments; entries of lists count from 0, or go by their name. Runs save no result "
             "fields unless `set` gives output.vtk: true.",
             to) +
         "\n" + texts_of(study_keys(), Level::debug, to);
}

std::optional<std::string> key_help(const std::string& path, Level most, const Terminal& to) {
  std::string text = help_on(scene_keys(), path, most, to);
  if (text.empty()) text = help_on(study_keys(), path, most, to);
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::string> word_help(const std::string& word, const Terminal& to) {
  std::string text = uses_of(scene_keys(), word, to);
  if (text.empty()) text = uses_of(study_keys(), word, to);
  return text.empty() ? std::nullopt : std::optional(text);
}

}  // namespace bulbus::inline app
