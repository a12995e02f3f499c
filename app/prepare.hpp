#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "app/scene/input_files.hpp"
#include "app/scene/scene.hpp"
#include "contact/interactions.hpp"
#include "core/mesh/quality.hpp"
#include "core/problem/problem.hpp"
#include "core/solve/unloaded_reference.hpp"

namespace bulbus::inline app {

/// A problem that is ready to march, and what is known of its mesh.
struct Prepared {
  std::unique_ptr<Problem> problem;
  std::shared_ptr<const Interactions> interactions;
  std::vector<RegionQuality> quality;
  std::vector<std::string> notes;           ///< on what of the mesh's file was left out
  std::vector<std::string> warnings;        ///< of mesh and model, the same on every rank
  std::vector<InputFile> inputs;            ///< as they were read
  std::shared_ptr<const Mesh> base;         ///< as it was drawn, of a scene with a reference
  std::optional<UnloadedReport> reference;  ///< once it has been searched
};

/// Refuses hexahedra that are inverted or, in a file, overlap. Throws InputError.
void refuse_unsound(const Mesh& base, const Scene& scene);

/// Makes the mesh, checks it and builds the problem. All steps are set up once in rehearsal, so that a slip
/// in the last of them is found before the first is solved. Throws InputError on every rank. Collective.
Prepared prepare(const Scene& scene, const Comm& comm);

}  // namespace bulbus::inline app
