#include "precond/make_preconditioner.hpp"

#include "precond/preconditioner_cache.hpp"

namespace bulbus::inline precond {

std::unique_ptr<PreconditionerFactory> make_preconditioner_factory(const LinearSettings& settings,
                                                                   Profiler& profiler) {
  return std::make_unique<PreconditionerCache>(settings, profiler);
}

std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Profiler& profiler) {
  if (settings.method == Method::direct) return make_direct_solver(settings, profiler);
  return make_krylov_solver(settings, make_preconditioner_factory(settings, profiler), profiler);
}

}  // namespace bulbus::inline precond
