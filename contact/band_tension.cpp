#include "contact/band_tension.hpp"

#include <numbers>

#include "core/base/error.hpp"

namespace bulbus::inline contact {

double band_opening(const RigidBodySpec& body, const std::string& name, const std::string& key) {
  if (!body.band || norm(body.direction) > 0 ||
      (body.band->arc.parts == 1 && body.band->arc.to - body.band->arc.from >= 360))
    throw scene_error(key, "'" + name + "' is no band whose arcs close radially: it has no hoop force",
                      "Name a `band` without `direction`, a whole ring of them in several `parts`.");
  return (body.band->arc.to - body.band->arc.from) * std::numbers::pi / 180;
}

double band_tension(const RigidSurface& band, double opening, std::span<const Wrench> on_arcs) {
  double outwards = 0;
  for (std::size_t p = 0; p < on_arcs.size(); ++p) outwards -= dot(on_arcs[p].force, band.parts[p].closes);
  return outwards / opening;
}

}  // namespace bulbus::inline contact
