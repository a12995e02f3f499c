#include "contact/law/midface_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bulbus::inline contact {
namespace {

constexpr double pressed = 0.25, free = 0.1;  // of the width of a face, its area's root (docs/decisions/035)

ContactSpec of_middles(ContactSpec spec) {
  spec.name += " (middles of faces)";
  spec.divisions = 1;
  spec.tolerance = 0;
  return spec;
}

}  // namespace

MidfaceCheck::MidfaceCheck(const ContactSpec& spec, const ContactDefaults& defaults,
                           const ContactSides& sides, const Comm& comm, const Halo& halo,
                           std::shared_ptr<const ContactTerm> nodes)
    : spec_(spec),
      comm_(comm),
      halo_(halo),
      rigid_(sides.master.rigid()),
      nodes_(std::move(nodes)),
      middles_(of_middles(spec), defaults, sides, comm) {}

Overlap MidfaceCheck::entered(const State& state) const {
  std::vector<double> active(state.x.size() / 3);
  for (int n : nodes_->active_nodes(state)) active[n] = 1;
  halo_.update_ghosts(active, 1);
  const double depth = comm_.max(nodes_->penetration(state));
  return of_all_ranks(
      middles_.inside(state,
                      [&](const SlavePoints::Point& p, double area) {
                        const bool any = std::ranges::any_of(p.nodes, [&](int n) { return active[n] > 0; });
                        return depth + (any || progress_ < 1 ? pressed : free) * std::sqrt(area);
                      }),
      comm_);
}

std::string MidfaceCheck::refusal(const State& state) const {
  const Overlap o = entered(state);
  if (o.points == 0) return {};
  return fmt::format(
      "contact '{}': '{}' enters between the nodes of '{}': the middles of {} faces lie inside, the deepest "
      "by {:.3g} mm at "
      "({:.4g}, {:.4g}, {:.4g}). It is finer than the faces: give the contact `divisions: 4`{}, or refine "
      "'{}'",
      spec_.name, spec_.master, spec_.slave, o.points, o.depth, o.place[0], o.place[1], o.place[2],
      rigid_ ? "" : " or `two_way: true`, or exchange slave and master", spec_.slave);
}

}  // namespace bulbus::inline contact
