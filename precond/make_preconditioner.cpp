#include "precond/make_preconditioner.hpp"

#include "precond/block_triangular.hpp"
#include "precond/displacement.hpp"

namespace bulbus {

PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Meters& meters) {
  return [factory = std::make_shared<DisplacementFactory>(settings), displacement = std::shared_ptr<Preconditioner>(),
          &meters](CoupledSystem& system, SetUp how) mutable {
    if (how == SetUp::anew || !displacement || !displacement->follow()) {
      how = SetUp::anew;
      displacement.reset();  // two would need the room of both
      displacement = factory->make(system);
    }
    meters.memory.set("displacement preconditioner", displacement->bytes());
    return MadePreconditioner{std::make_unique<BlockTriangular>(system, displacement), how};
  };
}

}  // namespace bulbus
