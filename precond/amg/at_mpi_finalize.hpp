#pragma once

namespace bulbus::inline precond {

/// Calls `action` at the start of MPI_Finalize, while MPI still works; the last one given is called first.
/// For libraries that are started on first use and must end before MPI does. MPI must be running. Not
/// collective.
void at_mpi_finalize(void (*action)());

}  // namespace bulbus::inline precond
