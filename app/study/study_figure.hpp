#pragma once
#include "app/plot/chart.hpp"
#include "app/study/study_results.hpp"

namespace bulbus::inline app {

/// One panel per figure over the first factor with numbers, a curve per combination of the others; of a study
/// that varies one factor at a time, a row per figure with a panel per factor.
Chart chart_of(const Study& study, const StudyResults& results);

}  // namespace bulbus::inline app
