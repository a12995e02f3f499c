#include "app/command_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/cli/completion.hpp"
#include "app/cli/man_page.hpp"
#include "app/cli/parser.hpp"
#include "app/cli/topics.hpp"
#include "app/commands.hpp"
#include "app/new/starting_scene.hpp"
#include "app/records/checkpoints.hpp"
#include "app/scene/help.hpp"
#include "core/base/error.hpp"
#include "core/base/memory.hpp"
#include "core/base/process.hpp"
#include "core/io/output.hpp"

namespace bulbus::inline app {
namespace {

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

// Where the run writes, and what it goes on from: of these two, what is not said follows from what is.
std::pair<std::string, std::string> places_of(const Arguments& given) {
  namespace fs = std::filesystem;
  const bool named = !given.restart.empty();
  const std::string checkpoint =
      named && fs::is_directory(given.restart) ? checkpoint_in(given.restart) : given.restart;
  std::string out = given.out;
  if (out.empty())
    out = named ? fs::path(checkpoint).parent_path().string()
                : results_of(given.scene) + (given.command == "trade" ? "_trade" : "");
  if (out.empty()) out = ".";
  return {out, given.restarts && !named ? checkpoint_in(out) : checkpoint};
}

bool is_a_study(const std::string& path, const std::vector<std::string>&) { return is_study(path); }

void expect_fitting(const Arguments& given, bool of_a_study) {
  if (given.command == "study" && !of_a_study)
    throw input_error(given.scene, 0, "is no study: it has neither 'scene' nor 'vary'",
                      "'bulbus help study' tells what it needs");
  if (of_a_study && given.command != "study" && given.command != "check")
    throw input_error(given.scene, 0, "is a study, not a scene", "solve it with 'bulbus study'");
}

int print_schema(const Arguments& given, std::ostream& out) {
  out << (given.first == "study" ? study_schema() : scene_schema()).dump(2) << "\n";
  return 0;
}

// Commands that read no scene; nothing of others.
std::optional<int> without_scene(const Parser& parser, const Comm& comm, const Terminal& to,
                                 std::ostream& out, std::ostream& err) {
  const Arguments& given = parser.given();
  const std::string& command = given.command;
  if (command == "help") return print_topic(parser, to, out, err);
  if (command == "schema") return print_schema(given, out);
  if (command == "matrix-market") return matrix_market(given.first, given.out, comm, out);
  int status = 0;
  if (command == "completion")
    out << (given.first == "zsh" ? zsh_completion : bash_completion)(parser.commands());
  else if (command == "man")
    out << man_page(parser);
  else if (command == "new")
    write_starting_scene(given.first, given.kind, comm, out);
  else if (command == "compare")
    comm.together([&] { status = compare(given.first, given.second, given.tolerances, out); });
  else if (command == "plot")
    out << plot(given.first, given.columns, given.over, given.out, comm) << "\n";
  else if (command == "report")
    out << report(given.first, given.second, given.out, comm) << "\n";
  else
    return std::nullopt;
  return status;
}

int with_scene(const Arguments& given, const Comm& comm, std::ostream& out) {
  const auto [out_dir, checkpoint] = places_of(given);
  const Log::Screen screen = given.screen();
  const bool of_a_study = read_together(given, comm, is_a_study);
  expect_fitting(given, of_a_study);
  if (of_a_study) {
    const Study study = read_together(given, comm, read_study);
    return given.command == "check" ? check_study(study, comm, screen)
                                    : run_study(study, out_dir, comm, screen);
  }
  if (given.command == "trade")
    return run_trade(given.scene, given.set, out_dir, {this_program(), given.repeat}, comm, screen);
  const Scene scene = read_together(given, comm, read_scene);
  if (given.command == "check") return check(scene, comm, screen);
  if (given.command == "run") return run(scene, given.scene, out_dir, comm, screen, checkpoint);
  if (given.command == "export")
    return export_scene(scene, given.scene, given.out, given.exported, comm, out);
  return write_mesh(scene, given.out, given.text ? GmshFormat{false, false} : GmshFormat{}, comm);
}

// Where a record could not be written.
std::string what_to_do(const Arguments& given, const std::string& fault) {
  const bool runs = given.command == "run";
  const bool full =
      fault.find("no space left") != std::string::npos || fault.find("a full disk") != std::string::npos;
  const bool goes_on = runs && std::filesystem::exists(checkpoint_in(places_of(given).first));
  return std::string(full ? "make room there, then" : "when that is mended,") + " the same command " +
         (goes_on ? "with --restart goes on"
          : runs  ? "begins anew"
                  : "goes on");
}

// What was written before stays. Other ranks may be waiting for this one: the caller ends them.
int out_of_memory(const Arguments& given, const Comm& comm, std::ostream& faults) {
  const std::string text = fmt::format(
      "{}: out of memory at {:.0f} MB; {:.0f} MB is what this machine, its control groups and ulimit allow\n"
      "  Take a coarser mesh, or a machine with more memory; 'bulbus check' tells what a run will need.",
      given.scene, 1e-6 * static_cast<double>(peak_resident_bytes()),
      1e-6 * static_cast<double>(machine_bytes()));
  if (comm.size() > 1) throw std::runtime_error(text);
  faults << text << std::endl;
  return given.command == "check" ? 2 : 1;
}

}  // namespace

int command_line(std::vector<std::string> arguments, const Comm& comm, std::ostream& out, std::ostream& err) {
  std::ostream silent(nullptr);
  std::ostream &said = comm.rank() == 0 ? out : silent, &faults = comm.rank() == 0 ? err : silent;
  const Terminal to = out.rdbuf() == std::cout.rdbuf() ? terminal_of(STDOUT_FILENO) : Terminal{};
  Parser parser;
  const Arguments& given = parser.given();
  try {
    if (const auto status = parser.parse(std::move(arguments), to, said, faults)) return *status;
    const auto status = without_scene(parser, comm, to, said, faults);
    return status ? *status : with_scene(given, comm, said);
  } catch (const OutputError& e) {
    faults << "bulbus: " << e.what() << "; " << what_to_do(given, e.what()) << std::endl;
    return 1;
  } catch (const InputError& e) {
    faults << located(e, given.scene, given.set).what() << std::endl;
    return 2;
  } catch (const std::bad_alloc&) {
    return out_of_memory(given, comm, faults);
  } catch (const std::length_error&) {
    return out_of_memory(given, comm, faults);
  }
}

}  // namespace bulbus::inline app
