#pragma once
#include "app/prepare.hpp"
#include "app/records/checkpoints.hpp"
#include "app/records/folder.hpp"
#include "core/io/log.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline app {

/// Finds the unloaded reference of a scene that has one, tells its iterations and puts the problem onto it,
/// or takes over what a checkpoint (null: none) has kept of it; writes the mesh into the folder. A scene
/// without is left as it is. False where none was found: `prepared.reference` says why, and the problem is as
/// it was drawn. Collective. Throws OutputError.
bool take_unloaded_reference(const Scene& scene, Prepared& prepared, const Checkpoint* from,
                             ResultsFolder& folder, const Log& log, Profiler& profiler);

/// The end of a run that has not found its reference.
MarchReport march_without(const UnloadedReport& reference);
/// What to try then.
std::string remedy_of(const UnloadedReport& reference);

}  // namespace bulbus::inline app
