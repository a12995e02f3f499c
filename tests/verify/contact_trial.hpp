#pragma once
#include "contact/interactions.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {

/// A trial with rigid bodies, contacts and sutures.
struct ContactTrial : Trial {
  std::shared_ptr<Interactions> interactions;
  explicit ContactTrial(const Scene& scene, const Comm& c = {})
      : Trial(scene, c), interactions(Interactions::attach(problem, scene.mesh)) {
    settings.newton = tight(1e-10);
  }
  const ContactTerm& contact(const std::string& name) const { return *interactions->contact(name, "").term; }
  int pairs(const std::string& name) const { return comm.sum(contact(name).figures(state).pairs); }
  /// On the master, of the model as it is drawn, N.
  Vec3<double> force(const std::string& name) const {
    Vec3<double> sum{0, 0, 0};
    for (const Wrench& w : contact(name).figures(state).on_master)
      for (int c = 0; c < 3; ++c) sum[c] += w.force[c];
    comm.sum(std::span<double>(sum));
    return sum;
  }
};

inline ContactSpec contact_between(const std::string& name, const std::string& slave,
                                   const std::string& master) {
  ContactSpec c;
  c.name = name, c.slave = slave, c.master = master;
  return c;
}

/// A block whose surfaces bear its name: "low xmin", ...
inline Mesh named_block(const std::string& name, const Point& lower, const Point& upper, int n, int nz) {
  Mesh mesh =
      generate(BlockShape{.lower = lower, .upper = upper, .nx = n, .ny = n, .nz = nz, .region = name});
  std::map<std::string, std::vector<Quad>> surfaces;
  for (const auto& [side, faces] : mesh.surfaces) surfaces[name + " " + side] = faces;
  mesh.surfaces = surfaces;
  return mesh;
}

/// A rigid body that is shifted.
inline MoveSpec shift(const std::string& body, const Point& way, const std::string& from = "here") {
  MoveSpec move;
  move.body = body, move.from = from, move.translate = way;
  return move;
}

}  // namespace bulbus
