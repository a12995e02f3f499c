#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "app/export/export_scene.hpp"
#include "app/records/comparison.hpp"
#include "app/study/study.hpp"
#include "core/base/parallel.hpp"
#include "core/io/log.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus::inline app {

/// Solves the scene into the folder, or goes on from a checkpoint (empty: none) and adds to the records
/// beside that. Returns the exit status: 0 finished, 1 not converged, 128 and the signal's number if it was
/// interrupted. Collective. Throws InputError before anything is written, and OutputError where a record
/// cannot be written: what was written before stays.
int run(const Scene& scene, const std::string& scene_path, const std::string& out_dir, const Comm& comm,
        Log::Screen screen = Log::Screen::shown, const std::string& checkpoint = "");

/// Prints sizes, mesh quality and a memory estimate; solves nothing. Collective. Throws InputError.
int check(const Scene& scene, const Comm& comm, Log::Screen screen = Log::Screen::shown);

/// Runs every scene of the study into out_dir/run_001 and so on, but those that are there already, and writes
/// table, trends and figure; Screen::verbose shows the log of every run. Returns the exit status: 0 all
/// converged, 1 not all. Collective. Throws InputError before the first run.
int run_study(const Study& study, const std::string& out_dir, const Comm& comm,
              Log::Screen screen = Log::Screen::shown);

/// Validates every scene of the study and prints what would be run. Collective. Throws InputError.
int check_study(const Study& study, const Comm& comm, Log::Screen screen = Log::Screen::shown);

/// How a trade is made.
struct TradeOptions {
  std::string program;  ///< the command `bulbus`, which solves each scene
  int repeat = 1;       ///< times that every run is made; the least processor time counts
};

/// Solves the scene with one setting after the other changed, each as a process of its own, into
/// out_dir/run_001 and so on, but for what is there already, and writes what each costs and how accurate it
/// is. Returns the exit status: 0 the reference converged, 1 it did not. For one rank. Throws InputError
/// before the first run.
int run_trade(const std::string& scene, const std::vector<std::string>& overrides, const std::string& out_dir,
              const TradeOptions& options, const Comm& comm, Log::Screen screen = Log::Screen::shown);

/// Prints the probes of two runs' folders at the end of every step, and their differences. Returns the exit
/// status: 0 none differs, 1 some do. Throws InputError if a folder has no history, a probe has two units, or
/// there is nothing to compare. Not collective.
int compare(const std::string& first, const std::string& second, const CompareOptions& options,
            std::ostream& out);

/// Draws columns of the history in a run's folder over another one (empty: the steps done), a panel each; all
/// probes if none is named. Of the folder of a trade it draws errors over processor time. The file (empty:
/// history.svg or trade.svg in the folder) is an SVG, or a PNG by the program rsvg-convert if it ends in
/// .png. Returns its path. Collective. Throws InputError and OutputError.
std::string plot(const std::string& folder, const std::vector<std::string>& columns, const std::string& over,
                 const std::string& file, const Comm& comm);

/// Writes the page of a run, of two runs side by side (`second` not empty) or of a study, to `file` or, if
/// that is empty, into the folder. Returns its path, on the first rank. Collective. Throws InputError, and
/// OutputError where it cannot be written.
std::string report(const std::string& folder, const std::string& second, const std::string& file,
                   const Comm& comm);
/// Writes a dumped linear system as Matrix Market files (empty: beside the dump) and prints their names.
/// Collective. Throws InputError.
int matrix_market(const std::string& dump, std::string file, const Comm& comm, std::ostream& out);

/// Writes the scene's mesh as a Gmsh file. Collective. Throws InputError on every rank.
int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm);

/// Writes mesh, sets and what else has an equivalent there for another program, which the file's ending
/// chooses: .inp (Abaqus, CalculiX), .feb (FEBio 4.0), .msh (Gmsh, the mesh alone). Prints what is left out.
/// Collective. Throws InputError and OutputError on every rank.
int export_scene(const Scene& scene, const std::string& scene_path, const std::string& file,
                 const ExportOptions& options, const Comm& comm, std::ostream& out);

}  // namespace bulbus::inline app
