#pragma once
#include <span>

#include "app/study/study_results.hpp"

namespace bulbus::inline app {

/// How figures go along a line.
struct Course {
  enum class Kind {
    unknown,
    constant,
    rising,
    falling,
    mixed
  };  ///< mixed: not monotone; unknown: fewer than two values
  Kind kind = Kind::unknown;
  std::vector<int> turns;  ///< where it changes between rising and falling
};

/// "rising", "not monotone", ...
const char* name_of(Course::Kind kind);

/// Changes below `tolerance` times the largest value count as none.
Course course_of(std::span<const double> values, double tolerance);

/// The course of one figure along one line, from the runs that converged.
struct Trend {
  Line line;
  int figure = 0;
  Course course;
  std::vector<int> runs;  ///< that converged, of the line
};

/// Of every figure along every line of every factor.
std::vector<Trend> trends_of(const Study& study, const StudyResults& results);

/// "rising", "not monotone: turns at 0.75".
std::string words_of(const Study& study, const StudyResults& results, const Trend& trend);

/// A table of figures by factors, and a line for every course that is not monotone.
std::vector<std::string> lines_of(const Study& study, const StudyResults& results,
                                  const std::vector<Trend>& trends);

}  // namespace bulbus::inline app
