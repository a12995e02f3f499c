#pragma once
#include <memory>

#include "core/base/parallel.hpp"
#include "core/solve/factorisation.hpp"

namespace bulbus::inline solve {

/// L U by Eigen, columns ordered by COLAMD: simple and slow, a reference for small systems. One rank.
std::unique_ptr<Factorisation> make_eigen(const Comm& comm);
constexpr int most_for_eigen = 20000;  ///< unknowns; more than that takes minutes

/// L U by SuperLU_DIST on all ranks, in the order of nested_dissection() as it exchanges no pivots; solutions
/// are refined. Collective.
std::unique_ptr<Factorisation> make_superlu_dist(const Comm& comm);

/// L U by UMFPACK: METIS on A + Aᵀ, pivots on the diagonal where they are large enough, two steps of
/// iterative refinement at most. One rank.
std::unique_ptr<Factorisation> make_umfpack(const Comm& comm);
/// Is it part of this build? (CMake: BULBUS_UMFPACK)
bool has_umfpack();

}  // namespace bulbus::inline solve
