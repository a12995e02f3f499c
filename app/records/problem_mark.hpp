#pragma once
#include "app/scene/input_files.hpp"
#include "app/scene/scene.hpp"
#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// What tells one problem from another: the mesh in a few numbers and the scene up to the step that is under
/// way, but for title, solver, output, how the mesh is made and how the steps are divided, and what the files
/// hold that it names.
struct ProblemMark {
  std::string scene;  ///< YAML
  std::string files;  ///< a line for each: hash and key
  std::vector<double>
      mesh;  ///< hexahedra, nodes, a hash of who is whose corner, and weighted sums of the positions
  /// Sums that tell what has a name in the mesh: of regions, bars, surfaces and node sets. Empty in
  /// checkpoints of versions that did not keep them.
  std::vector<double> named;
  void serialize(Archive& archive);
};

/// Collective.
ProblemMark mark_of(const Scene& scene, const std::vector<InputFile>& inputs, const Problem& problem,
                    int step);

/// Throws InputError that names what differs; `path` is that of the checkpoint, `inputs` are the files of the
/// scene `here`.
void refuse_another(const ProblemMark& kept, const ProblemMark& here, const std::vector<InputFile>& inputs,
                    const std::string& path);

}  // namespace bulbus::inline app
