#pragma once
#include <string>

#include "app/study.hpp"
#include "core/base/parallel.hpp"
#include "core/io/log.hpp"
#include "core/mesh/gmsh.hpp"

namespace bulbus {

/// Solves the scene into the folder, or goes on from a checkpoint (empty: none) and adds to the records beside that. Returns the exit
/// status: 0 finished, 1 not converged. Collective. Throws InputError before anything is written.
int run(const Scene& scene, const std::string& scene_path, const std::string& out_dir, const Comm& comm,
        Log::Screen screen = Log::Screen::shown, const std::string& checkpoint = "");

/// Prints sizes, mesh quality and a memory estimate; solves nothing. Collective. Throws InputError.
int check(const Scene& scene, const Comm& comm);

/// Runs every scene of the study into out_dir/run_001 and so on, but those that are there already, and writes table,
/// trends and figure. Returns the exit status: 0 all converged, 1 not all. Collective. Throws InputError before the
/// first run.
int run_study(const Study& study, const std::string& out_dir, const Comm& comm);

/// Validates every scene of the study and prints what would be run. Collective. Throws InputError.
int check_study(const Study& study, const Comm& comm);

/// Writes the scene's mesh as a Gmsh file. Collective. Throws InputError on every rank.
int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm);

}  // namespace bulbus
