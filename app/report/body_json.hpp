#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "app/report/run_record.hpp"

namespace bulbus::inline app {

/// States of equally many values, each packed as its difference to the one before.
nlohmann::json packed_states(const std::vector<std::vector<std::uint16_t>>& states);

/// Positions (3 per node, mm) in several states, quantised in the box of all of them.
nlohmann::json places_json(const std::vector<std::vector<float>>& states);

/// The triangles of the rigid bodies in these frames of the run; null where there are none, or where one of
/// the files is missing. Throws std::runtime_error.
nlohmann::json bodies_json(const RunRecord& run, const std::vector<int>& frames);

/// Bars and strings of sutures in these frames, whose number may change; null where there are none.
nlohmann::json lines_json(const RunRecord& run, const std::vector<int>& frames);

}  // namespace bulbus::inline app
