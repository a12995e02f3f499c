#pragma once
#include <nlohmann/json_fwd.hpp>

#include "app/study/study_trend.hpp"

namespace bulbus::inline app {

/// What study.json holds: factors, figures, runs done, and the trend of every figure along every line.
nlohmann::json json_of(const Study& study, const StudyResults& results, const std::vector<Trend>& trends);

}  // namespace bulbus::inline app
