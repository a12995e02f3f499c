#pragma once
#include <algorithm>
#include <cmath>

namespace bulbus {

/// The larger of two errors; a NaN, which std::max and MPI_MAX may pass over, is infinitely large.
inline double worse(double a, double b) { return std::isnan(b) ? INFINITY : std::max(a, b); }

}  // namespace bulbus
