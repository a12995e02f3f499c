#pragma once
#include <memory>
#include <vector>

#include "app/scene/input_files.hpp"
#include "app/scene/scene.hpp"
#include "contact/interactions.hpp"
#include "core/mesh/quality.hpp"
#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// A problem that is ready to march, and what is known of its mesh.
struct Prepared {
  std::unique_ptr<Problem> problem;
  std::shared_ptr<const Interactions> interactions;
  std::vector<RegionQuality> quality;
  std::vector<std::string> notes;     ///< on what of the mesh's file was left out
  std::vector<std::string> warnings;  ///< of mesh and model, the same on every rank
  std::vector<InputFile> inputs;      ///< as they were read
};

/// Makes the mesh, checks it and builds the problem. All steps are set up once in rehearsal, so that a slip
/// in the last of them is found before the first is solved. Throws InputError on every rank. Collective.
Prepared prepare(const Scene& scene, const Comm& comm);

}  // namespace bulbus::inline app
