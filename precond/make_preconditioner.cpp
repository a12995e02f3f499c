#include "precond/make_preconditioner.hpp"

#include "precond/block_triangular.hpp"
#include "precond/operators/displacement.hpp"

namespace bulbus {

PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Profiler& profiler) {
  return [factory = std::make_shared<DisplacementFactory>(settings), pressures = settings.pressures,
          displacement = DisplacementInverse(), parts = std::make_shared<BlockTriangular::Parts>(),
          &profiler](CoupledSystem& system, SetUp how) mutable {
    if (how != SetUp::kept || !displacement.inverse || !displacement.inverse->follow()) {
      const bool own_lines = system.problem().mesh().refinements > 0;  // have the corrections
      if (how == SetUp::anew || !own_lines) *parts = {};
      displacement = {};  // two would need the room of both
      displacement = factory->make(system, how != SetUp::anew);
      how = displacement.factors_kept ? SetUp::factors_kept : SetUp::anew;
      if (how == SetUp::anew) *parts = {};
    }
    profiler.memory.set("displacement preconditioner", displacement.inverse->bytes());
    return MadePreconditioner{std::make_unique<BlockTriangular>(system, displacement, pressures, *parts),
                              how};
  };
}

std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Profiler& profiler) {
  if (settings.method == Method::direct) return make_direct_solver(settings, profiler);
  return make_krylov_solver(settings, make_preconditioner_factory(settings, profiler), profiler);
}

}  // namespace bulbus
