#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Under what the mesh is drawn, where it is not drawn unloaded, and how its unloaded reference is searched
/// (formulation, section 4.3).
struct ReferenceSpec {
  std::map<std::string, std::string> loaded;
  std::vector<LoadSpec> loads;
  std::vector<DisplaceSpec> displace;
  double tolerance = 1e-6;
  int max_iterations = 60, depth = 8;
  template <class V>
  void describe(V&& v) {
    v("loaded", loaded,
      About{"liquids, and the pressure under which the mesh is drawn", Quantity::stress}.expression());
    v("loads", loads,
      About{"pressures on surfaces and forces on nodes under which it is drawn, as in a step"});
    v("displace", displace,
      About{"prescribed displacements under which it is drawn, from the unloaded positions"});
    v("tolerance", tolerance,
      About{"largest distance of a node from its drawn position once the loads act again; on meshes of less "
            "than 10 mm at most 1e-7 of their size",
            Quantity::length}
          .positive());
    v("max_iterations", max_iterations, About{"iterations before the load is divided"}.between(1, 1000));
    v("depth", depth,
      About{"earlier iterations that Anderson's acceleration combines; 0: plain fixed point"}
          .between(0, 50)
          .expert());
  }
};

}  // namespace bulbus::inline problem
