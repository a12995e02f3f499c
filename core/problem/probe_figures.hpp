#pragma once
#include "core/problem/probes.hpp"

/// The figures behind ProbeSet, in mm, N, MPa. Making one and asking it are collective.
namespace bulbus::probes {

/// Component x, y or z, length, or distance from the z axis.
double component_of(const Vec3<double>& v, const std::string& component);

/// Local numbers of the set's nodes that this rank owns.
std::vector<int> owned_nodes(const Problem& problem, const std::string& set);

/// Component of every node of the set, then mean, max or min. The radial displacement is the change of the
/// distance from the z axis.
ProbeSet::Figure displacement(const Problem& problem, const ProbeSpec& spec);
ProbeSet::Figure position(const Problem& problem, const ProbeSpec& spec);
/// Component of the mean place of `to` minus that of `set`.
ProbeSet::Figure distance(const Problem& problem, const ProbeSpec& spec);

/// Force with which the supports hold the set. `radial` sums the nodes' forces away from the z axis: the
/// (negative) squeeze of a ring, whose resultant is nothing.
ProbeSet::Figure reaction(const Problem& problem, const ProbeSpec& spec);
/// Its moment about the origin, arms in the deformed state.
ProbeSet::Figure moment(const Problem& problem, const ProbeSpec& spec);
/// Axial force of whole bars.
ProbeSet::Figure bar_force(const Problem& problem, const ProbeSpec& spec);

ProbeSet::Figure pressure(const Problem& problem, const ProbeSpec& spec);
ProbeSet::Figure volume(const Problem& problem, const ProbeSpec& spec);

/// Smallest stress that is not exceeded in `percentile` per cent of the region's volume.
ProbeSet::Figure mises(const Problem& problem, const ProbeSpec& spec);
/// V_e / V0_e.
ProbeSet::Figure volume_ratio(const Problem& problem, const ProbeSpec& spec);

/// Mean, max or min over all ranks' numbers. Collective.
double statistic(const Comm& comm, const std::string& kind, std::span<const double> numbers);

}  // namespace bulbus::probes
