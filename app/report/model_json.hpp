#pragma once
#include <nlohmann/json_fwd.hpp>

#include "app/report/run_record.hpp"

namespace bulbus::inline app {

/// The model of a run for page/data.js: surfaces, hexahedra, rigid bodies and lines in every saved state, at
/// most about `limit` bytes as text. What does not fit is thinned out, states first, then the inside of the
/// solid, then its surface; `notes` say so. Null if the run has no result files. Throws std::runtime_error.
nlohmann::json model_json(const RunRecord& run, double limit);

}  // namespace bulbus::inline app
