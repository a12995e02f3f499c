#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"

namespace bulbus::inline app {

/// The kinds of scene to begin with: an eye, a sphere, a mesh from a file.
std::vector<std::string> starting_scenes();

/// Writes a commented scene of that kind as NAME.yaml (the name may have that ending), and for `mesh`
/// NAME.msh beside it, which stands for a mesh of one's own. Prints what it wrote and what may be done with
/// it. Collective. Throws InputError if there is such a file already, and OutputError.
void write_starting_scene(std::string name, const std::string& kind, const Comm& comm, std::ostream& out);

}  // namespace bulbus::inline app
