#include "precond/amg/at_mpi_finalize.hpp"

#include <mpi.h>

namespace bulbus::inline precond {
namespace {

int call(MPI_Comm, int, void* action, void*) {
  reinterpret_cast<void (*)()>(action)();
  return MPI_SUCCESS;
}

}  // namespace

// MPI-3.1, section 8.7.1: MPI_Finalize first deletes the attributes of MPI_COMM_SELF in reverse order.
void at_mpi_finalize(void (*action)()) {
  int key = MPI_KEYVAL_INVALID;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, call, &key, nullptr);
  MPI_Comm_set_attr(MPI_COMM_SELF, key, reinterpret_cast<void*>(action));
  MPI_Comm_free_keyval(&key);
}

}  // namespace bulbus::inline precond
