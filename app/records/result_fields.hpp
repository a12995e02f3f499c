#pragma once
#include <string>
#include <vector>

#include "contact/interactions.hpp"
#include "core/io/vtkhdf.hpp"
#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus::inline app {

/// Of the local nodes, mm.
std::vector<Point> reference_points(const LocalMesh& mesh);

/// What a result file holds of a state: the wanted of `output.fields`, and the regions' names
/// as labels `region_NAME`. Stresses are Cauchy's, positive in tension; `pressure` is positive in
/// compression. `points` must outlive the piece. Collective.
Piece piece_of(Snapshot& snapshot, const Interactions& interactions, const std::vector<std::string>& wanted,
               const std::vector<Point>& points);

}  // namespace bulbus::inline app
