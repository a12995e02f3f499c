#include "precond/make_preconditioner.hpp"

#include "precond/block_triangular.hpp"
#include "precond/displacement.hpp"

namespace bulbus {

PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Meters& meters) {
  return [factory = std::make_shared<DisplacementFactory>(settings), pressures = settings.pressures, &meters](CoupledSystem& system) {
    auto displacement = factory->make(system);
    meters.memory.set("displacement preconditioner", displacement.inverse->bytes());
    return std::make_unique<BlockTriangular>(system, std::move(displacement), pressures);
  };
}

}  // namespace bulbus
