#include "app/cli/man_page.hpp"

#include <fmt/format.h>

#include "app/records/log_columns.hpp"
#include "app/scene/key_lines.hpp"
#include "app/version.hpp"

namespace bulbus::inline app {
namespace {

// As roff shows it unchanged: no escapes, no requests, hyphens that are minus signs, not to be broken.
std::string roff(const std::string& text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (char c : text)
    out += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  return out;
}

std::string strong(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string variable(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string section(const std::string& name) { return ".SH " + name + "\n"; }

// A term, and what it means.
std::string item(const std::string& term, const std::string& meaning) {
  return ".TP\n" + term + "\n" + meaning + "\n";
}

std::string value_of(const ArgumentOutline& a) {
  return a.words.empty() ? variable(a.value) : fmt::format("{}", fmt::join(a.words, "|"));
}

std::string term_of(const ArgumentOutline& a) {
  std::string names;
  for (const std::string& name : a.names) names += (names.empty() ? "" : ", ") + strong(name);
  if (a.names.empty()) return variable(a.value);
  return a.value.empty() ? names : names + " " + value_of(a);
}

std::string usage_of(const CommandOutline& command) {
  std::string text = strong("bulbus " + command.name);
  for (const ArgumentOutline& a : command.arguments)
    if (a.names.empty() || a.required) {
      const std::string shown = a.names.empty() ? variable(a.value) + (a.repeated ? " ..." : "") : term_of(a);
      text += a.required ? " " + shown : " [" + shown + "]";
    }
  return text + " [" + variable("options") + "]";
}

std::string command_section(const CommandOutline& command) {
  std::string text =
      ".SS " + command.name + "\n" + usage_of(command) + "\n.PP\n" + roff(command.about) + ".\n";
  for (const ArgumentOutline& a : command.arguments)
    if (a.names.empty() || a.names.back() != "--help") text += item(term_of(a), roff(a.about));
  return text;
}

std::string keys_section(const std::vector<KeyLine>& keys) {
  std::string text;
  for (const KeyLine& k : keys)
    if (k.level == Level::everyday)
      text += item(strong(plain_path(k.path)), roff(k.facts) + "\n.br\n" + roff(k.help));
  return text;
}

const char* const description =
    R"(computes how soft incompressible tissue with enclosed liquid deforms at large
strain, and where it touches. A scene is a YAML file that names mesh, materials, liquids, contacts, the steps of loading and the
figures to record;)";

const char* const statuses = R"(.TP
0
done; two runs that are compared agree
.TP
1
a run did not converge, two runs differ, or a record could not be written
.TP
2
the input or the command line is wrong: one message with file, line and remedy
.TP
130, 143
interrupted by SIGINT, SIGTERM, with complete records: \fB\-\-restart\fR goes on
)";

const char* const environment = R"(.TP
NO_COLOR
if it is not empty, nothing is coloured
.TP
PATH
leads to rsvg\-convert, by which \fBbulbus plot\fR draws PNG files
)";

}  // namespace

std::string man_page(const Parser& parser) {
  std::string page = fmt::format(".TH BULBUS 1 \"\" \"bulbus {}\" \"User Commands\"\n.nh\n", version);
  page += section("NAME") + "bulbus \\- finite\\-strain analysis of soft tissue coupled to enclosed liquid\n";
  page += section("SYNOPSIS");
  for (const CommandOutline& command : parser.commands()) page += usage_of(command) + "\n.br\n";
  page += strong("mpirun -n") + " " + variable("ranks") + " " + strong("bulbus run") + " ...\n";
  page += section("DESCRIPTION") + strong("bulbus") + "\n" + description + "\n" + strong("bulbus new") +
          " writes one to begin with, and " + strong("bulbus help") + " explains every key.\n";
  page += section("COMMANDS");
  for (const CommandOutline& command : parser.commands()) page += command_section(command);
  page +=
      section("SCENE") +
      "Keys for everyday use, by their path; lengths in mm, forces in N, stresses in MPa, angles in rad. " +
      strong("bulbus help scene --all") + " shows the others.\n" + keys_section(scene_keys());
  page += section("STUDY") + keys_section(study_keys());
  page += section("LOG") + roff(newton_table().of) + "\n";
  for (const LogColumn& column : newton_table().columns)
    page += item(strong(column.name), roff(column.meaning));
  return page + section("EXIT STATUS") + statuses + section("ENVIRONMENT") + environment;
}

}  // namespace bulbus::inline app
