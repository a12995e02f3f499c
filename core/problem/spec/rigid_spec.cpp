#include "core/problem/spec/rigid_spec.hpp"

#include "core/base/error.hpp"
#include "core/base/require_one.hpp"

namespace bulbus::inline problem {

void RigidBodySpec::validate() const { require_one("the rigid body", "shape", optional_members(*this)); }

void SutureSpec::validate() const {
  require_one("the suture", "placement",
              {{"pair", pair.has_value()}, {"points", !points.empty()}, {"sets", !sets.empty()}});
  if (points.size() > 2 || sets.size() > 2)
    throw input_error("a suture has more than two points", "make two sutures of it");
  if (!sets.empty() && bite != SutureSpec{}.bite)
    throw input_error("`bite` has no effect on `sets`, whose nodes share the force equally", "leave it out");
  if (sets.empty() && surface.empty())
    throw input_error("the suture has no surface",
                      "add 'surface: ...', the surface of the mesh that its points lie on");
}

}  // namespace bulbus::inline problem
