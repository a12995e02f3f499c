#pragma once
#include "core/problem/probes/probes.hpp"

/// The figures behind ProbeSet, in mm, N, MPa. Making one and asking it are collective.
namespace bulbus::inline problem::probes {

/// Of forces on nodes: their sum, their moment about the origin, and the sum of their components away from
/// the z axis.
struct Resultant {
  Vec3<double> force{}, moment{};
  double radial = 0;
  void add(const Vec3<double>& place, const Vec3<double>& f);
  /// Component of the force.
  double component(const std::string& c) const;
};

Resultant with_images(const Problem& problem, Resultant r);
/// Sum of all ranks, with the symmetry images if `of` is "whole", without them if it is "part". Collective.
Resultant total(const Problem& problem, const Resultant& own, const std::string& of);

/// Component x, y or z, length, or distance from the z axis.
double component_of(const Vec3<double>& v, const std::string& component);

/// Local numbers of the set's nodes that this rank owns.
std::vector<int> owned_nodes(const Problem& problem, const std::string& set);

/// Component of every node of the set, then mean, max or min. Displacements count from the snapshot's origin;
/// the radial one is the change of the distance from the z axis.
ProbeSet::Figure displacement(const Problem& problem, const ProbeSpec& spec);
ProbeSet::Figure position(const Problem& problem, const ProbeSpec& spec);
/// Component of the mean place of `to` minus that of `set`.
ProbeSet::Figure distance(const Problem& problem, const ProbeSpec& spec);
/// Mean distance from the z axis of `to` minus that of `set`: how far a buckle's crest stands inwards of the
/// wall beside it.
ProbeSet::Figure buckle_height(const Problem& problem, const ProbeSpec& spec);

/// Force with which the supports hold the set. `radial` is the (negative) squeeze of a ring, whose resultant
/// is nothing.
ProbeSet::Figure reaction(const Problem& problem, const ProbeSpec& spec);
/// Its moment about the origin, arms in the deformed state.
ProbeSet::Figure moment(const Problem& problem, const ProbeSpec& spec);
/// Axial force of whole bars.
ProbeSet::Figure bar_force(const Problem& problem, const ProbeSpec& spec);

ProbeSet::Figure pressure(const Problem& problem, const ProbeSpec& spec);
ProbeSet::Figure volume(const Problem& problem, const ProbeSpec& spec);

/// Smallest stress that is not exceeded in `percentile` per cent of the volume of the region, or of its cells
/// that touch the set.
ProbeSet::Figure mises(const Problem& problem, const ProbeSpec& spec);
/// The same of the cells that touch one of these local nodes, ghosts included.
ProbeSet::Figure mises_around(const Problem& problem, const ProbeSpec& spec, std::span<const int> nodes);
/// Mean over the part of the region that lies at most `within` from one of these positions (undeformed, mm):
/// a volume that a finer mesh does not make smaller.
ProbeSet::Figure mean_mises_near(const Problem& problem, const ProbeSpec& spec,
                                 std::span<const Point> places);
/// V_e / V0_e.
ProbeSet::Figure volume_ratio(const Problem& problem, const ProbeSpec& spec);

/// Mean, max or min over all ranks' numbers. Collective.
double statistic(const Comm& comm, const std::string& kind, std::span<const double> numbers);

}  // namespace bulbus::inline problem::probes
