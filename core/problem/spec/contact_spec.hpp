#pragma once
#include <string>

#include "core/base/parameters.hpp"

namespace bulbus::inline problem {

/// Frictionless penalty contact between the nodes or the faces' points of one surface (slave, the softer
/// side) and the faces of another or of a rigid body (master).
struct ContactSpec {
  std::string name, slave, master, start = "refuse";
  double penalty = 0, depth = 0, tolerance = 0;
  int divisions = 0;
  bool two_way = false;
  template <class V>
  void describe(V&& v) {
    v("name", name, About{"name in records and probes"}.needed());
    v("slave", slave, About{"surface whose nodes are kept out of the master: the softer side"}.needed());
    v("master", master, About{"surface of the mesh, or rigid body"}.needed());
    v("penalty", penalty,
      About{"pressure per penetration, MPa/mm; 0: chosen from the softer side and the thinner layer"}
          .at_least(0));
    v("depth", depth,
      About{"a point deeper than this at the start of the run is not in contact; later its history decides; "
            "0: half the thinner layer",
            Quantity::length}
          .at_least(0));
    v("tolerance", tolerance,
      About{"largest penetration; the augmented-Lagrangian loop drives it below this; 0: penalty alone",
            Quantity::length}
          .at_least(0));
    v("divisions", divisions,
      About{"slave points; 0: the nodes of the slave; n: n x n points on each of its faces, for "
            "edges of a rigid body finer than the mesh"}
          .between(0, 100));
    v("two_way", two_way,
      About{"the master's nodes are kept out of the slave's faces too, between surfaces of the mesh whose "
            "master has corners or "
            "faces finer than the slave's"});
    v("start", start,
      About{"surfaces that overlap at the start: `refuse` them or `resolve` the overlap gradually over the "
            "first step"}
          .one_of({"refuse", "resolve"}));
  }
};

}  // namespace bulbus::inline problem
