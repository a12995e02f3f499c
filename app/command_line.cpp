#include "app/command_line.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/records/checkpoints.hpp"
#include "app/scene/help.hpp"
#include "app/version.hpp"
#include "core/base/error.hpp"
#include "core/base/memory.hpp"
#include "core/base/process.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {
namespace {

struct Arguments {
  std::string scene, out, restart, topic, first, second;
  std::vector<std::string> set, probes;
  bool text = false, expert = false, all = false;
  int repeat = 1;
  CompareOptions tolerances;
  ExportOptions exported;
};

struct Parser {
  Arguments given;
  CLI::App app{"Bulbus: finite strains of the eye, with enclosed liquids", "bulbus"};
  CLI::App* run = app.add_subcommand("run", "solve a scene");
  CLI::App* study = app.add_subcommand("study", "solve a scene for all values of some of its keys");
  CLI::App* trade = app.add_subcommand(
      "trade",
      "solve a scene with one setting after the other changed: what each costs, and how accurate it is");
  CLI::App* check =
      app.add_subcommand("check", "validate a scene or a study and print its sizes; solves nothing");
  CLI::App* mesh = app.add_subcommand("mesh", "write the mesh of a scene as a Gmsh file");
  CLI::App* to_file = app.add_subcommand(
      "export", "write mesh, sets, materials and steps of a scene for Abaqus, CalculiX or FEBio");
  CLI::App* compare = app.add_subcommand(
      "compare", "probes of two runs at the end of each step: exit status 0 if they agree, 1 if they differ");
  CLI::App* plot = app.add_subcommand("plot", "draw probes of a run over its steps (SVG)");
  CLI::App* report = app.add_subcommand(
      "report", "a run, two runs side by side or a study as one page for a browser, with the model in 3-D");
  CLI::App* market =
      app.add_subcommand("matrix-market", "write a dumped linear system as Matrix Market files");
  CLI::App* help =
      app.add_subcommand("help", "the keys of a scene or a study, or the JSON schema of a scene");

  CLI::Option* restart = nullptr;

  Parser() {
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("bulbus ") + version);
    for (CLI::App* command : {run, trade, check, mesh, to_file}) {
      command->add_option("SCENE", given.scene, "scene file (YAML)")->required();
      add_set(command);
    }
    study->add_option("STUDY", given.scene, "study file (YAML)")->required();
    add_set(study);
    for (CLI::App* command : {run, study, trade})
      command->add_option("-o", given.out, "folder of the results (default: results/ and the file's name)")
          ->type_name("DIR");
    trade
        ->add_option("--repeat", given.repeat,
                     "times that every run is made; the least processor time counts")
        ->check(CLI::Range(1, 100));
    restart =
        run->add_option("--restart", given.restart,
                        "go on from the checkpoint of the results' folder, or of another folder or file")
            ->type_name("[FROM]")
            ->expected(0, 1);
    mesh->add_option("-o", given.out, "file to write (MSH 4.1, binary)")->type_name("FILE.msh")->required();
    mesh->add_flag("--text", given.text, "write MSH 2.2 text instead");
    to_file->add_option("--to", given.out, "file to write: .inp (Abaqus, CalculiX), .feb (FEBio 4.0), .msh")
        ->type_name("FILE")
        ->required();
    to_file
        ->add_option("--element", given.exported.element,
                     "element of an .inp file: C3D8I suits CalculiX, C3D8H (exactly incompressible) Abaqus")
        ->check(CLI::IsMember({"C3D8", "C3D8I", "C3D8H", "C3D8R"}))
        ->capture_default_str();
    to_file
        ->add_option("--bulk", given.exported.bulk,
                     "bulk modulus in parts of each region's shear modulus: those programs are compressible")
        ->check(CLI::Range(1., 1e9))
        ->capture_default_str();
    compare->add_option("DIR", given.first, "folder of the results of a run")->required();
    compare->add_option("DIR2", given.second, "and of another")->required();
    compare
        ->add_option("--relative", given.tolerances.relative,
                     "difference that counts as none, in parts of the probe's largest value")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    compare
        ->add_option("--absolute", given.tolerances.absolute,
                     "difference that counts as none, in the probe's unit")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    plot->add_option("DIR", given.first, "folder of the results of a run")->required();
    plot->add_option("PROBE", given.probes, "columns of history.csv (default: every probe)");
    plot->add_option("-o", given.out, "file to write (default: history.svg in the folder)")
        ->type_name("FILE.svg");
    report->add_option("DIR", given.first, "folder of the results of a run or of a study")->required();
    report->add_option("DIR2", given.second, "of another run, to compare with");
    report->add_option("-o", given.out, "file to write (default: report.html or comparison.html in DIR)")
        ->type_name("FILE.html");
    market->add_option("DUMP", given.first, "system of a run with solver.linear.dump: system_0001.h5")
        ->required();
    market
        ->add_option("-o", given.out,
                     "file of the matrix (default: beside the dump); others get its name and theirs")
        ->type_name("FILE.mtx");
    help->add_option("TOPIC", given.topic, "scene, study or schema")
        ->required()
        ->check(CLI::IsMember({"scene", "study", "schema"}));
    help->add_flag("--expert", given.expert, "of a scene, the settings for experts too");
    help->add_flag("--all", given.all, "of a scene, those for debugging as well");
  }

 private:
  void add_set(CLI::App* command) {
    command
        ->add_option("--set", given.set, "overrides, such as solver.linear.gamma=20 or steps.0.increments=4")
        ->type_name("PATH=VALUE ...")
        ->allow_extra_args(false);
  }
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

std::string results_of(const std::string& scene) {
  return (std::filesystem::path("results") / std::filesystem::path(scene).stem()).string();
}

// A rank that cannot see the file must not leave the others waiting.
template <class Read>
auto read_together(const Arguments& given, const Comm& comm, Read read) {
  decltype(read(given.scene, given.set)) content;
  std::string fault;
  try {
    content = read(given.scene, given.set);
  } catch (const InputError& e) {
    fault = e.what();
  }
  if (comm.any(!fault.empty()))
    throw InputError(fault.empty() ? given.scene + ": cannot be read on every rank" : fault);
  return content;
}

void print_topic(const Arguments& given, std::ostream& out) {
  if (given.topic == "scene")
    out << scene_help(given.all ? Level::debug : given.expert ? Level::expert : Level::everyday);
  else if (given.topic == "study")
    out << study_help();
  else
    out << scene_schema().dump(2) << "\n";
}

// Where the run writes, and what it goes on from: of these two, what is not said follows from what is.
std::pair<std::string, std::string> places_of(const Parser& parser) {
  namespace fs = std::filesystem;
  const Arguments& given = parser.given;
  const bool named = !given.restart.empty();
  const std::string checkpoint =
      named && fs::is_directory(given.restart) ? checkpoint_in(given.restart) : given.restart;
  std::string out = given.out;
  if (out.empty())
    out = named ? fs::path(checkpoint).parent_path().string()
                : results_of(given.scene) + (*parser.trade ? "_trade" : "");
  if (out.empty()) out = ".";
  return {out, *parser.restart && !named ? checkpoint_in(out) : checkpoint};
}

bool is_a_study(const std::string& path, const std::vector<std::string>&) { return is_study(path); }

void expect_fitting(const Parser& parser, bool of_a_study) {
  const std::string& file = parser.given.scene;
  if (*parser.study && !of_a_study)
    throw input_error(file, 0, "is no study: it has neither 'scene' nor 'vary'",
                      "'bulbus help study' tells what it needs");
  if (of_a_study && (*parser.run || *parser.trade || *parser.mesh || *parser.to_file))
    throw input_error(file, 0, "is a study, not a scene", "solve it with 'bulbus study'");
}

int dispatch(const Parser& parser, const Comm& comm, std::ostream& out) {
  const Arguments& given = parser.given;
  if (*parser.help) {
    print_topic(given, out);
    return 0;
  }
  if (*parser.compare) {
    int status = 0;
    comm.together([&] { status = compare(given.first, given.second, given.tolerances, out); });
    return status;
  }
  if (*parser.plot) {
    const std::string file = given.out.empty() ? given.first + "/history.svg" : given.out;
    plot_history(given.first, given.probes, "", file, comm);
    out << file << "\n";
    return 0;
  }
  if (*parser.report) {
    out << report(given.first, given.second, given.out, comm) << "\n";
    return 0;
  }
  if (*parser.market) return matrix_market(given.first, given.out, comm, out);
  const auto [out_dir, checkpoint] = places_of(parser);
  const bool of_a_study = read_together(given, comm, is_a_study);
  expect_fitting(parser, of_a_study);
  if (of_a_study) {
    const Study study = read_together(given, comm, read_study);
    return *parser.check ? check_study(study, comm) : run_study(study, out_dir, comm);
  }
  if (*parser.trade) return run_trade(given.scene, given.set, out_dir, {this_program(), given.repeat}, comm);
  const Scene scene = read_together(given, comm, read_scene);
  if (*parser.check) return check(scene, comm);
  if (*parser.run) return run(scene, given.scene, out_dir, comm, Log::Screen::shown, checkpoint);
  if (*parser.to_file) return export_scene(scene, given.scene, given.out, given.exported, comm, out);
  return write_mesh(scene, given.out, given.text ? GmshFormat{false, false} : GmshFormat{}, comm);
}

// Where a record could not be written.
std::string what_to_do(const Parser& parser, const std::string& fault) {
  const bool full =
      fault.find("no space left") != std::string::npos || fault.find("a full disk") != std::string::npos;
  const bool goes_on = *parser.run && std::filesystem::exists(checkpoint_in(places_of(parser).first));
  return std::string(full ? "make room there, then" : "when that is mended,") + " the same command " +
         (goes_on       ? "with --restart goes on"
          : *parser.run ? "begins anew"
                        : "goes on");
}

// What was written before stays. Other ranks may be waiting for this one: the caller ends them.
int out_of_memory(const Parser& parser, const Comm& comm, std::ostream& faults) {
  const std::string text = fmt::format(
      "{}: out of memory at {:.0f} MB; {:.0f} MB is what this machine, its control groups and ulimit allow\n"
      "  Take a coarser mesh, or a machine with more memory; 'bulbus check' tells what a run will need.",
      parser.given.scene, 1e-6 * static_cast<double>(peak_resident_bytes()),
      1e-6 * static_cast<double>(machine_bytes()));
  if (comm.size() > 1) throw std::runtime_error(text);
  faults << text << std::endl;
  return *parser.check ? 2 : 1;
}

}  // namespace

int command_line(std::vector<std::string> arguments, const Comm& comm, std::ostream& out, std::ostream& err) {
  std::ostream silent(nullptr);
  std::ostream &said = comm.rank() == 0 ? out : silent, &faults = comm.rank() == 0 ? err : silent;
  Parser parser;
  try {
    arguments = scene_before_restart(one_set_each(arguments));
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    parser.app.parse(arguments);
    return dispatch(parser, comm, said);
  } catch (const CLI::ParseError& e) {
    return parser.app.exit(e, said, faults) == 0 ? 0 : 2;
  } catch (const OutputError& e) {
    faults << "bulbus: " << e.what() << "; " << what_to_do(parser, e.what()) << std::endl;
    return 1;
  } catch (const InputError& e) {
    faults << located(e, parser.given.scene, parser.given.set).what() << std::endl;
    return 2;
  } catch (const std::bad_alloc&) {
    return out_of_memory(parser, comm, faults);
  } catch (const std::length_error&) {
    return out_of_memory(parser, comm, faults);
  }
}

}  // namespace bulbus::inline app
