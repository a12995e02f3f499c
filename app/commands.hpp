#pragma once
#include <string>

#include "app/scene.hpp"
#include "core/base/parallel.hpp"
#include "core/mesh/gmsh.hpp"

namespace bulbus {

/// Solves the scene into the folder. Returns the exit status: 0 finished, 1 not converged. Collective. Throws
/// InputError before anything is written.
int run(const Scene& scene, const std::string& scene_path, const std::string& out_dir, const Comm& comm);

/// Prints sizes, mesh quality and a memory estimate; solves nothing. Collective. Throws InputError.
int check(const Scene& scene, const Comm& comm);

/// Writes the scene's mesh as a Gmsh file. Collective. Throws InputError on every rank.
int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm);

}  // namespace bulbus
