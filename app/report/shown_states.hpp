#pragma once
#include <string>
#include <vector>

#include "app/report/run_record.hpp"
#include "app/report/solid_surface.hpp"

namespace bulbus::inline app {

/// A scalar of the saved states for the cells or the nodes that are shown.
struct ShownField {
  std::string name, unit;
  bool on_cells = false;
  std::vector<std::vector<float>> values;  ///< per state; NaN where there is no value
};

/// The saved states as far as they are shown.
struct ShownStates {
  std::vector<float> reference;               ///< 3 per node, mm
  std::vector<std::vector<float>> positions;  ///< per state, 3 per node, mm
  std::vector<ShownField> fields;
};

/// The mesh of the saved states, pieces joined, and the region of every cell. Throws std::runtime_error.
struct SavedSolid {
  SavedMesh mesh;
  std::vector<int> regions;
  std::vector<std::string> region_names;
};
SavedSolid read_solid(const RunRecord& run);

/// `frames`: which of the run's. Throws std::runtime_error if a file cannot be read or has another mesh.
ShownStates read_states(const RunRecord& run, const std::vector<int>& frames, const SavedSolid& saved,
                        const ShownSolid& shown);

/// Scalars of the files that pages colour by: `mises` of the cells, gaps and contact pressures of the nodes.
std::vector<ShownField> shown_fields(const RunRecord& run);

}  // namespace bulbus::inline app
