#include "app/cli/parser.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "app/new/starting_scene.hpp"
#include "app/version.hpp"
#include "core/base/did_you_mean.hpp"

namespace bulbus::inline app {
namespace {

// A range lets "nan" through, which is neither below nor above it.
std::string no_nan(const std::string& text) {
  return std::isnan(std::strtod(text.c_str(), nullptr)) ? "Value " + text + " is no number" : "";
}

// What stands for its value; empty of a flag.
std::string value_text(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  if (option.get_items_expected_max() == 0) return "";
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));  // without what its checks say
}

// Descriptions broken to the width of the terminal; values without types and checks.
class WrappingFormatter final : public CLI::Formatter {
 public:
  explicit WrappingFormatter(int width) : width_(width) {}
  std::string make_option_desc(const CLI::Option* option) const override {
    return broken(option->get_description());
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_positional()) return "";
    const std::string value = value_text(*option), fallback = option->get_default_str();
    return (value.empty() ? "" : " " + value) + (fallback.empty() ? "" : "=" + fallback) +
           (option->get_required() ? " REQUIRED" : "");
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_display_name(true), broken(command->get_description()),
                             column_width_);
    return out.str();
  }

 private:
  std::string broken(const std::string& text) const {
    const int left = width_ - static_cast<int>(column_width_);
    return left < 20 ? text : wrapped(text, left);
  }
  int width_;
};

// `--set a=1 b=2 SCENE` becomes `--set a=1 --set b=2 SCENE`: CLI11 would take the scene for a third override.
std::vector<std::string> one_set_each(const std::vector<std::string>& arguments) {
  std::vector<std::string> out;
  bool after_value = false;
  for (const std::string& a : arguments) {
    const bool more = after_value && a.find('=') != std::string::npos && a[0] != '-';
    if (more) out.emplace_back("--set");
    after_value = more || (!out.empty() && out.back() == "--set");
    out.push_back(a);
  }
  return out;
}

// `--restart SCENE` becomes `SCENE --restart`: CLI11 would take the scene for the checkpoint.
std::vector<std::string> scene_before_restart(std::vector<std::string> arguments) {
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--restart" &&
        (arguments[i + 1].ends_with(".yaml") || arguments[i + 1].ends_with(".yml")))
      std::swap(arguments[i], arguments[i + 1]);
  return arguments;
}

std::vector<const CLI::App*> all_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    std::ranges::copy(names_of(*option), std::back_inserter(names));
  return names;
}

// Of an option that the command lacks, or else of an argument too many.
InputError unexpected(const CLI::App& command, const std::vector<std::string>& extras,
                      const std::string& help) {
  const auto option = std::ranges::find_if(extras, [](const std::string& e) { return e.starts_with("-"); });
  const std::string called = "'bulbus " + command.get_name() + "' ";
  if (option == extras.end()) return input_error(called + "takes no further '" + extras.front() + "'", help);
  const std::string name = option->substr(0, option->find('='));
  return input_error(called + "has no option '" + name + "'",
                     did_you_mean(name, option_names(command), help));
}

}  // namespace

struct Parser::Declared {
  Arguments given;
  CLI::App app{"Bulbus: finite strains of the eye, with enclosed liquids", "bulbus"};
  std::map<const CLI::Option*, std::vector<std::string>> words;
  CLI::Option* restart = nullptr;

  Declared() {
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("bulbus ") + version);
    declare_new();
    declare_runs();
    declare_files();
    declare_records();
    declare_about();
  }

  void refuse_unknown_command(const std::vector<std::string>& arguments) const {
    if (arguments.empty()) throw input_error("no command is given", "'bulbus help' lists the commands");
    std::vector<std::string> names;
    for (const CLI::App* c : all_commands(app)) names.push_back(c->get_name());
    const std::string& first = arguments.front();
    if (first.starts_with("-") || std::ranges::find(names, first) != names.end()) return;
    throw input_error("there is no command '" + first + "'",
                      did_you_mean(first, names, "'bulbus help' lists the commands"));
  }

  InputError wrong_usage(const CLI::ParseError& fault) const {
    const auto commands = app.get_subcommands();
    const CLI::App& at = commands.empty() ? app : *commands.front();
    const std::string name = commands.empty() ? "" : " " + at.get_name();
    const std::string help = "'bulbus" + name + " --help' tells what it takes";
    if (const auto extras = app.remaining(true); !commands.empty() && !extras.empty())
      return unexpected(at, extras, help);
    return input_error("bulbus" + name + ": " + fault.what(), help);
  }

 private:
  CLI::App* command(const char* name, const char* about) { return app.add_subcommand(name, about); }

  CLI::Option* choice(CLI::App* of, const char* name, std::string& value, const char* about,
                      const std::vector<std::string>& among) {
    CLI::Option* option = of->add_option(name, value, about)
                              ->check(CLI::IsMember(among))
                              ->type_name(fmt::format("{}", fmt::join(among, "|")));
    words[option] = among;
    return option;
  }

  void declare_new() {
    CLI::App* fresh = command("new", "write a scene to begin with, commented line by line");
    fresh->add_option("NAME", given.first, "the scene is NAME.yaml, which must not be there yet")->required();
    choice(fresh, "--kind", given.kind,
           "the half eye, a sphere full of liquid, or a mesh of your own, for which NAME.msh stands",
           starting_scenes())
        ->capture_default_str();
  }

  void declare_runs() {
    CLI::App* run = command("run", "solve a scene");
    CLI::App* check = command("check", "validate a scene or a study and print its sizes; solves nothing");
    CLI::App* study = command("study", "solve a scene for all values of some of its keys");
    CLI::App* trade =
        command("trade",
                "solve a scene with one setting after the other changed: what each costs, and how accurate "
                "it is");
    for (CLI::App* c : {run, check, trade}) add_scene(c);
    study->add_option("STUDY", given.scene, "study file (YAML)")->required();
    for (CLI::App* c : {run, check, study, trade}) {
      add_set(c);
      CLI::Option* quiet = c->add_flag("-q,--quiet", given.quiet, "print nothing but warnings and errors");
      if (c == run || c == study)
        c->add_flag("-v,--verbose", given.verbose,
                    c == run ? "print every Krylov iteration too, and where time and memory went"
                             : "print the log of every run")
            ->excludes(quiet);
    }
    for (CLI::App* c : {run, study, trade})
      c->add_option("-o", given.out, "folder of the results (default: results/ and the file's name)")
          ->type_name("DIR");
    trade
        ->add_option("--repeat", given.repeat,
                     "times that every run is made; the least processor time counts")
        ->check(CLI::Range(1, 100))
        ->type_name("TIMES");
    restart =
        run->add_option("--restart", given.restart,
                        "go on from the checkpoint of the results' folder, or of another folder or file")
            ->type_name("[FROM]")
            ->expected(0, 1);
  }

  void declare_files() {
    CLI::App* mesh = command("mesh", "write the mesh of a scene as a Gmsh file");
    CLI::App* to_file =
        command("export", "write mesh, sets, materials and steps of a scene for Abaqus, CalculiX or FEBio");
    for (CLI::App* c : {mesh, to_file}) {
      add_scene(c);
      add_set(c);
    }
    mesh->add_option("-o", given.out, "file to write (MSH 4.1, binary)")->type_name("FILE.msh")->required();
    mesh->add_flag("--text", given.text, "write MSH 2.2 text instead");
    to_file->add_option("--to", given.out, "file to write: .inp (Abaqus, CalculiX), .feb (FEBio 4.0), .msh")
        ->type_name("FILE")
        ->required();
    choice(to_file, "--element", given.exported.element,
           "element of an .inp file: C3D8I suits CalculiX, C3D8H (exactly incompressible) Abaqus",
           {"C3D8", "C3D8I", "C3D8H", "C3D8R"})
        ->capture_default_str();
    to_file
        ->add_option("--bulk", given.exported.bulk,
                     "bulk modulus in parts of each region's shear modulus: those programs are compressible")
        ->check(CLI::Range(1., 1e9))
        ->check(no_nan)
        ->type_name("NUMBER")
        ->capture_default_str();
    CLI::App* market = command("matrix-market", "write a dumped linear system as Matrix Market files");
    market->add_option("DUMP", given.first, "system of a run with solver.linear.dump: system_0001.h5")
        ->required();
    market
        ->add_option("-o", given.out,
                     "file of the matrix (default: beside the dump); others get its name and theirs")
        ->type_name("FILE.mtx");
  }

  void declare_records() {
    CLI::App* compare =
        command("compare",
                "probes of two runs at the end of each step: exit status 0 if they agree, 1 if they differ");
    compare->add_option("DIR", given.first, "folder of the results of a run")->required();
    compare->add_option("DIR2", given.second, "and of another")->required();
    compare
        ->add_option("--relative", given.tolerances.relative,
                     "difference that counts as none, in parts of the probe's largest value")
        ->check(CLI::NonNegativeNumber)
        ->type_name("NUMBER")
        ->capture_default_str();
    compare
        ->add_option("--absolute", given.tolerances.absolute,
                     "difference that counts as none, in the probe's unit")
        ->check(CLI::NonNegativeNumber)
        ->type_name("NUMBER")
        ->capture_default_str();
    CLI::App* plot =
        command("plot", "draw columns of a run's history over its steps, or what a trade found (SVG or PNG)");
    plot->add_option("DIR", given.first, "folder of the results of a run or of a trade")->required();
    plot->add_option("COLUMN", given.columns, "columns of history.csv (default: every probe)");
    plot->add_option("--over", given.over, "the column along the abscissa (default: time, the steps done)")
        ->type_name("COLUMN");
    plot->add_option("-o", given.out,
                     "file to write, .svg or .png, which needs rsvg-convert (default: history.svg or "
                     "trade.svg in DIR)")
        ->type_name("FILE");
    CLI::App* report = command(
        "report", "a run, two runs side by side or a study as one page for a browser, with the model in 3-D");
    report->add_option("DIR", given.first, "folder of the results of a run or of a study")->required();
    report->add_option("DIR2", given.second, "of another run, to compare with");
    report->add_option("-o", given.out, "file to write (default: report.html or comparison.html in DIR)")
        ->type_name("FILE.html");
  }

  void declare_about() {
    CLI::App* help = command("help", "explain a command or a key; without a topic, list the topics");
    help->add_option("TOPIC", given.topic,
                     "scene, study, units, log, a command, a key such as probes, solver.linear or "
                     "increments, or a value such as gap");
    help->add_flag("--expert", given.expert, "of a scene, the settings for experts too");
    help->add_flag("--all", given.all, "of a scene, those for debugging as well");
    CLI::App* schema = command("schema", "print the JSON schema of a scene or a study, for editors");
    choice(schema, "OF", given.first, "scene (default) or study", {"scene", "study"});
    CLI::App* completion = command("completion", "print the completion of this command line for a shell");
    choice(completion, "SHELL", given.first, "bash or zsh", {"bash", "zsh"})->required();
    command("man", "print the manual page (roff)");
  }

  void add_scene(CLI::App* c) { c->add_option("SCENE", given.scene, "scene file (YAML)")->required(); }

  void add_set(CLI::App* c) {
    c->add_option("--set", given.set, "overrides, such as solver.linear.gamma=20 or steps.0.increments=4")
        ->type_name("PATH=VALUE ...")
        ->allow_extra_args(false);
  }
};

Parser::Parser() : declared_(std::make_unique<Declared>()) {}
Parser::~Parser() = default;

std::optional<int> Parser::parse(std::vector<std::string> arguments, const Terminal& to, std::ostream& out,
                                 std::ostream& err) {
  CLI::App& app = declared_->app;
  app.formatter(std::make_shared<WrappingFormatter>(to.width));
  for (CLI::App* command : app.get_subcommands({})) command->formatter(app.get_formatter());
  try {
    declared_->refuse_unknown_command(arguments);
    arguments = scene_before_restart(one_set_each(arguments));
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) throw declared_->wrong_usage(e);
    app.exit(e, out, err);
    return 0;
  }
  declared_->given.command = app.get_subcommands().front()->get_name();
  declared_->given.restarts = declared_->restart->count() > 0;
  return std::nullopt;
}

const Arguments& Parser::given() const { return declared_->given; }

std::string Parser::about() const { return declared_->app.get_description(); }

std::vector<CommandOutline> Parser::commands() const {
  std::vector<CommandOutline> commands;
  for (const CLI::App* c : all_commands(declared_->app)) {
    CommandOutline& command = commands.emplace_back(c->get_name(), c->get_description());
    for (const CLI::Option* o : c->get_options()) {
      ArgumentOutline& a = command.arguments.emplace_back();
      a.names = names_of(*o);
      a.value = value_text(*o);
      a.about = o->get_description();
      if (!o->get_default_str().empty()) a.about += " (default: " + o->get_default_str() + ")";
      if (const auto words = declared_->words.find(o); words != declared_->words.end())
        a.words = words->second;
      a.required = o->get_required();
      a.repeated = o->get_items_expected_max() > 1;
    }
  }
  return commands;
}

}  // namespace bulbus::inline app
