#pragma once
#include <vector>

#include "core/base/parallel.hpp"
#include "core/base/tensor.hpp"

namespace bulbus::inline contact {

struct Wrench {
  Vec3<double> force{0, 0, 0};   ///< N
  Vec3<double> moment{0, 0, 0};  ///< about the origin, N·mm
};

inline Vec3<double> moment_about(const Vec3<double>& point, const Wrench& w) {
  return minus(w.moment, cross(point, w.force));
}

/// Figures of one contact on one rank: sums and the largest penetration are those of its slave points.
struct ContactFigures {
  int pairs = 0;    ///< active ones
  double area = 0;  ///< current area in contact, mm²: of faces up to where contact ends on them, and no less
                    ///< than the force over the largest nodal pressure; of points on faces as in
                    ///< area_in_contact()
  double penetration = 0;         ///< largest, mm
  std::vector<Wrench> on_master;  ///< per part of a rigid body; one in all for a master of the mesh
};

/// A slave node that this rank owns.
struct ContactNode {
  int node;    ///< local
  double gap;  ///< mm: distance to the master; negative where that keeps the node out, infinite where it was
               ///< not looked for so far away
  double pressure = 0;          ///< force over current tributary area, MPa
  Vec3<double> force{0, 0, 0};  ///< on the node, N
  bool active = false;
};

/// Slave points that are inside the master, on one rank.
struct Overlap {
  int points = 0;
  Vec3<double> place{0, 0, 0};  ///< of the deepest
  double depth = 0;             ///< mm
  void add(double other, const Vec3<double>& where) {
    if (++points == 1 || other > depth) depth = other, place = where;
  }
};

/// The count of all ranks, and the deepest of them. Collective.
Overlap of_all_ranks(const Overlap& mine, const Comm& comm);

/// How the augmented-Lagrangian loop of the current increment went, the same on every rank.
struct Augmentation {
  int updates = 0;
  double violation =
      0;  ///< largest penetration, or gap that a multiplier presses across, at the last look, mm
  bool gave_up = false;  ///< still above the tolerance after the last allowed update
};

/// What a contact knows of every pair of slave point and master piece at the end of an increment.
struct ContactMemory {
  std::vector<int> triangle;     ///< where tracking starts, −1: none
  std::vector<double> pressure;  ///< multiplier p, MPa
  std::vector<double>
      overlap;  ///< mm inside at the start, made good while the first step proceeds; empty: none
};

}  // namespace bulbus::inline contact
