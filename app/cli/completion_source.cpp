#include "app/cli/completion_source.hpp"

#include "app/cli/topics.hpp"
#include "app/scene/key_lines.hpp"

namespace bulbus::inline app {
namespace {

// A line for each key that holds a value: `path=word word`.
std::string settable_keys() {
  std::string lines;
  for (const KeyLine& k : scene_keys()) {
    if (k.group || k.has_keys) continue;
    lines += k.path + "=";
    for (const std::string& word : k.words) lines += (lines.back() == '=' ? "" : " ") + word;
    lines += "\n";
  }
  return lines;
}

std::string lines_of_topics() {
  std::string lines;
  for (const Topic& topic : topics()) lines += topic.name + "\n";
  for (const auto& keys : {scene_keys(), study_keys()})
    for (const KeyLine& k : keys) lines += plain_path(k.path) + "\n";
  return lines;
}

// Paths are walked part by part: 0 stands for any place in a list, NAME for any name of a map.
const char* const functions = R"sh(
_bulbus_keys() {
  local typed=$1 head= key rest given part
  [[ $typed == *.* ]] && head=${typed%.*}.
  while IFS= read -r key; do
    rest=${key%%=*} given=$head
    while [[ -n $given ]]; do
      part=${rest%%.*}
      [[ $rest == *.* && ( $part == "${given%%.*}" || $part == 0 || $part == NAME ) ]] || continue 2
      rest=${rest#*.} given=${given#*.}
    done
    case $rest in
      NAME*) ;;
      *.*) printf '%s\n' "$head${rest%%.*}." ;;
      *) printf '%s\n' "$head$rest=" ;;
    esac
  done <<< "$_bulbus_settings" | sort -u
}

_bulbus_words() {
  local key rest given part
  while IFS= read -r key; do
    rest=${key%%=*}. given=$1.
    while [[ -n $given && -n $rest ]]; do
      part=${rest%%.*}
      [[ $part == "${given%%.*}" || $part == 0 || $part == NAME ]] || continue 2
      rest=${rest#*.} given=${given#*.}
    done
    [[ -z $given$rest ]] && printf '%s\n' "${key#*=}"
  done <<< "$_bulbus_settings"
}

_bulbus_topics() {
  local typed=$1 head= topic rest
  [[ $typed == *.* ]] && head=${typed%.*}.
  while IFS= read -r topic; do
    rest=${topic#"$head"}
    [[ $topic == "$head"* && -n $rest ]] && printf '%s\n' "$head${rest%%.*}"
  done <<< "$_bulbus_help_topics" | sort -u
}
)sh";

std::string shell_quoted(const std::string& text) { return "'" + text + "'"; }

}  // namespace

Offered offered_for(const ArgumentOutline& a) {
  if (!a.words.empty()) return Offered::words;
  if (a.value.starts_with("PATH=")) return Offered::settings;
  if (a.value == "TOPIC") return Offered::topics;
  if (a.value == "SCENE" || a.value == "STUDY") return Offered::scenes;
  if (a.value.starts_with("DIR")) return Offered::folders;
  if (a.value.starts_with("FILE") || a.value == "DUMP" || a.value == "[FROM]") return Offered::files;
  return Offered::nothing;
}

std::string shell_functions() {
  std::string settings = settable_keys(), names = lines_of_topics();
  settings.pop_back();  // the last line's end
  names.pop_back();
  return "_bulbus_settings=" + shell_quoted(settings) + "\n\n_bulbus_help_topics=" + shell_quoted(names) +
         "\n" + functions;
}

}  // namespace bulbus::inline app
