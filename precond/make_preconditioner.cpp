#include "precond/make_preconditioner.hpp"

#include "precond/block_triangular.hpp"
#include "precond/displacement.hpp"

namespace bulbus {

PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Meters& meters) {
  return [settings, &meters](CoupledSystem& system) {
    auto displacement = make_displacement_preconditioner(system, settings);
    meters.memory.set("displacement preconditioner", displacement->bytes());
    return std::make_unique<BlockTriangular>(system, std::move(displacement));
  };
}

}  // namespace bulbus
