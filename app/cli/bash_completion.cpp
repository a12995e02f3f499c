#include <fmt/format.h>

#include "app/cli/completion.hpp"
#include "app/cli/completion_source.hpp"

namespace bulbus::inline app {
namespace {

std::string words_joined(const std::vector<std::string>& words, const char* between) {
  return fmt::format("{}", fmt::join(words, between));
}

// What is run for the value of an argument, of which $cur has been typed.
std::string action_of(const ArgumentOutline& a) {
  switch (offered_for(a)) {
    case Offered::words:
      return "COMPREPLY=($(compgen -W '" + words_joined(a.words, " ") + "' -- \"$cur\"))";
    case Offered::settings:
      return "_bulbus_setting";
    case Offered::topics:
      return "compopt -o nospace 2>/dev/null; COMPREPLY=($(compgen -W \"$(_bulbus_topics \"$cur\")\" -- "
             "\"$cur\"))";
    case Offered::scenes:
      return "_bulbus_files yaml";
    case Offered::folders:
      return "COMPREPLY=($(compgen -d -- \"$cur\"))";
    case Offered::files:
      return "_bulbus_files any";
    default:
      return ":";
  }
}

// Branches by the option before the word: what is offered as its value.
std::string values_of_options(const CommandOutline& command) {
  std::string text;
  for (const ArgumentOutline& a : command.arguments)
    if (!a.names.empty() && !a.value.empty())
      text += fmt::format("        {}) {}; return ;;\n", words_joined(a.names, "|"), action_of(a));
  return text;
}

// The first positional argument decides for all of them: files or folders.
std::string positional_of(const CommandOutline& command) {
  for (const ArgumentOutline& a : command.arguments)
    if (a.names.empty()) return action_of(a);
  return ":";
}

std::string options_of(const CommandOutline& command) {
  std::string text;
  for (const ArgumentOutline& a : command.arguments)
    if (!a.names.empty()) text += (text.empty() ? "" : " ") + words_joined(a.names, " ");
  return text;
}

std::string branch_of(const CommandOutline& command) {
  const std::string values = values_of_options(command);
  return fmt::format("    {})\n", command.name) +
         (values.empty() ? "" : "      case $prev in\n" + values + "      esac\n") +
         fmt::format(
             "      if [[ $cur == -* ]]; then COMPREPLY=($(compgen -W '{}' -- \"$cur\"))\n"
             "      else {}\n      fi ;;\n",
             options_of(command), positional_of(command));
}

// Words are split at blanks alone: bash itself splits them at = too, and then replaces what is behind it.
const char* const bash_frame = R"sh(
_bulbus_setting() {
  if [[ $cur != *=* ]]; then
    COMPREPLY=($(compgen -W "$(_bulbus_keys "$cur")" -- "$cur"))
    ((${#COMPREPLY[@]})) && compopt -o nospace 2>/dev/null
  elif [[ $COMP_WORDBREAKS == *=* ]]; then
    COMPREPLY=($(compgen -W "$(_bulbus_words "${cur%%=*}")" -- "${cur#*=}"))
  else
    COMPREPLY=($(compgen -P "${cur%%=*}=" -W "$(_bulbus_words "${cur%%=*}")" -- "${cur#*=}"))
  fi
}

_bulbus_files() {
  local file
  compopt -o filenames 2>/dev/null
  while IFS= read -r file; do
    [[ -d $file || $1 == any || $file == *.yaml || $file == *.yml ]] && COMPREPLY+=("$file")
  done < <(compgen -f -- "$cur")
}

_bulbus() {
  local cur prev words
  COMPREPLY=()
  read -ra words <<< "${COMP_LINE:0:COMP_POINT}"
  [[ ${COMP_LINE:0:COMP_POINT} == *[[:space:]] ]] && words+=("")
  cur=${words[-1]}
  prev=${words[-2]:-}
  # --set takes several values
  [[ $prev == *=* && ${words[*]} == *--set* && $cur != -* ]] && {
    _bulbus_setting
    [[ $cur == *=* ]] || _bulbus_files yaml
    return
  }
  if ((${#words[@]} <= 2)); then
    COMPREPLY=($(compgen -W '@COMMANDS@ --help --version' -- "$cur"))
    return
  fi
  case ${words[1]} in
)sh";

}  // namespace

std::string bash_completion(const std::vector<CommandOutline>& commands) {
  std::vector<std::string> names;
  std::string branches, head = bash_frame;
  for (const CommandOutline& c : commands) {
    names.push_back(c.name);
    branches += branch_of(c);
  }
  const std::string mark = "@COMMANDS@";
  head.replace(head.find(mark), mark.size(), words_joined(names, " "));
  return "# Completion of bulbus for bash, made by `bulbus completion bash`.\n" + shell_functions() + head +
         branches + "  esac\n}\n\ncomplete -F _bulbus bulbus\n";
}

}  // namespace bulbus::inline app
