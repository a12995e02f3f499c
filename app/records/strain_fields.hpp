#pragma once
#include "core/io/vtkhdf.hpp"
#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus::inline app {

/// Fields of the local hexahedra; F = ∂x/∂X is that of their middle.

/// `strain`: Green–Lagrange, ½ (FᵀF − 1).
Field green_strain(const Snapshot& snapshot);
/// `principal_stretches`: singular values of F, the largest first.
Field principal_stretches(const Snapshot& snapshot);
/// `principal_stresses` (MPa): eigenvalues of the mean Cauchy stress, the largest first.
Field principal_stresses(Snapshot& snapshot);

}  // namespace bulbus::inline app
