#include <fmt/format.h>

#include "app/cli/completion.hpp"
#include "app/cli/completion_source.hpp"

namespace bulbus::inline app {
namespace {

// Within single quotes, and within the [] or behind the : of a specification.
std::string safe(const std::string& text) {
  std::string out;
  for (char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out;
}

std::string zsh_action(const ArgumentOutline& a) {
  switch (offered_for(a)) {
    case Offered::words:
      return fmt::format("({})", fmt::join(a.words, " "));
    case Offered::settings:
      return "_bulbus_setting";
    case Offered::topics:
      return "_bulbus_topic";
    case Offered::scenes:
      return "_files -g \"*.(yaml|yml)\"";
    case Offered::folders:
      return "_directories";
    case Offered::files:
      return "_files";
    default:
      return " ";
  }
}

// As _arguments wants it: '(-q --quiet)'{-q,--quiet}'[about]:value:action'.
std::string specification(const ArgumentOutline& a) {
  const std::string value = a.value.empty() ? "" : fmt::format(":{}:{}", safe(a.value), zsh_action(a));
  if (a.names.empty()) return fmt::format("'{}{}'", a.repeated ? "*" : "", value);
  const std::string about = fmt::format("[{}]{}", safe(a.about), value);
  if (a.repeated) return fmt::format("'*{}{}'", a.names[0], about);
  if (a.names.size() == 1) return fmt::format("'{}{}'", a.names[0], about);
  return fmt::format("'({})'{{{}}}'{}'", fmt::join(a.names, " "), fmt::join(a.names, ","), about);
}

const char* const helpers = R"sh(
_bulbus_setting() {
  local -a found
  if [[ $PREFIX == *=* ]]; then
    found=(${=$(_bulbus_words "${PREFIX%%=*}")})
    compset -P '*='
    compadd -a found
  else
    found=(${(f)"$(_bulbus_keys "$PREFIX")"})
    compadd -S '' -a found
  fi
}

_bulbus_topic() {
  local -a found
  found=(${(f)"$(_bulbus_topics "$PREFIX")"})
  compadd -S '' -a found
}
)sh";

}  // namespace

std::string zsh_completion(const std::vector<CommandOutline>& commands) {
  std::string names, branches;
  for (const CommandOutline& c : commands) {
    names += fmt::format("    '{}:{}'\n", c.name, safe(c.about));
    branches += fmt::format("    {}) _arguments", c.name);
    for (const ArgumentOutline& a : c.arguments) branches += " \\\n      " + specification(a);
    branches += " ;;\n";
  }
  return "#compdef bulbus\n# Completion of bulbus for zsh, made by `bulbus completion zsh`.\n" +
         shell_functions() + helpers + "\n_bulbus() {\n  local state line\n  local -a commands=(\n" + names +
         "  )\n  _arguments -C '--version[print the version]' '1:command:->command' "
         "'*::argument:->argument'\n"
         "  [[ $state == command ]] && _describe command commands && return\n  case $words[1] in\n" +
         branches + "  esac\n}\n\n_bulbus \"$@\"\n";
}

}  // namespace bulbus::inline app
