#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/parameters.hpp"
#include "core/mesh/mesh.hpp"
#include "core/problem/spec/contact_spec.hpp"
#include "core/problem/spec/material_spec.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline problem {

/// What a scene says of the physics, as plain data: Problem is built from a Mesh and a Model. Defaults, units
/// and bounds stand here and nowhere else.

/// W = Σ c_rs (Ī1 − 3)^r (Ī2 − 3)^s of one region, one of the other laws, or a rigid body in its place.
struct RegionSpec {
  struct Term {
    int r = 0, s = 0;
    double c = 0;
    template <class V>
    void describe(V&& v) {
      v("r", r, About{"power of (I1 - 3)"}.between(0, 9));
      v("s", s, About{"power of (I2 - 3)"}.between(0, 9));
      v("c", c, About{"coefficient c_rs", Quantity::stress}.needed());
    }
  };
  double c10 = 0, c01 = 0, c20 = 0, c11 = 0, c02 = 0, c30 = 0;
  std::vector<Term> terms;
  std::optional<FungSpec> fung;
  std::optional<FibresSpec> fibres;
  bool rigid = false;
  template <class V>
  void describe(V&& v) {
    v("c10", c10,
      About{"coefficient of (I1 - 3); half the shear modulus of a neo-Hookean tissue", Quantity::stress});
    v("c01", c01, About{"coefficient of (I2 - 3) (Mooney-Rivlin)", Quantity::stress});
    v("c20", c20, About{"coefficient of (I1 - 3)^2", Quantity::stress});
    v("c11", c11, About{"coefficient of (I1 - 3)(I2 - 3)", Quantity::stress});
    v("c02", c02, About{"coefficient of (I2 - 3)^2", Quantity::stress});
    v("c30", c30, About{"coefficient of (I1 - 3)^3", Quantity::stress});
    v("terms", terms, About{"further terms c_rs (I1 - 3)^r (I2 - 3)^s"});
    v("fung", fung, About{"a law that stiffens, a/(2b) (exp(b (I1 - 3)) - 1), in place of all coefficients"});
    v("fibres", fibres, About{"families of dispersed fibres (Holzapfel-Gasser-Ogden) beside c10"});
    v("rigid", rigid, About{"the region moves as one rigid body: six unknowns, no material"});
  }
};

/// Bars of a group: total Lagrangian, linear in Green strain.
struct BarSpec {
  double E = 100, area = 1e-3;
  bool tension_only = false;
  template <class V>
  void describe(V&& v) {
    v("E", E, About{"Young's modulus", Quantity::stress}.positive());
    v("area", area, About{"cross-section of one bar", Quantity::area}.positive());
    v("tension_only", tension_only, About{"bars go slack instead of pushing"});
  }
};

/// Enclosed liquid: P = P_i + K (V_i − V) / V_i, on every face of a surface.
struct LiquidSpec {
  std::string surface;
  double K = 2083.3;
  template <class V>
  void describe(V&& v) {
    v("surface", surface,
      About{"the surface of the cavity: closed, or closed by the symmetry planes"}.needed());
    v("K", K, About{"bulk modulus", Quantity::stress}.positive());
  }
};

/// Directions of a set that never move.
struct FixSpec {
  std::string set;
  std::vector<std::string> directions{"x", "y", "z"};
  template <class V>
  void describe(V&& v) {
    v("set", set, About{"node set, surface or region"}.needed());
    v("directions", directions, About{"the constrained directions"}.one_of({"x", "y", "z"}));
  }
};

/// Prescribed displacement of a set. A plain number is reached linearly by the end of the step; a formula in
/// X, Y, Z (mm, reference position), s (0 to 1 over the step) and t (steps done + s) is taken as it stands.
struct DisplaceSpec {
  using Rotation = RotationSpec;
  std::string set;
  std::optional<std::string> x, y, z, radial, by;
  Point axis{0, 0, 1}, center{0, 0, 0}, along{0, 0, 0};
  std::optional<std::vector<double>> affine;
  std::optional<Rotation> rotate;
  std::optional<Point> translate;
  std::string from = "reference";
  template <class V>
  void describe(V&& v) {
    v("set", set, About{"node set, surface or region"}.needed());
    v("x", x, About{"displacement in x", Quantity::length}.expression());
    v("y", y, About{"displacement in y", Quantity::length}.expression());
    v("z", z, About{"displacement in z", Quantity::length}.expression());
    v("radial", radial,
      About{"displacement away from `axis`, tangentially free", Quantity::length}.expression());
    v("axis", axis, About{"axis of `radial`"});
    v("center", center, About{"a point of the axis of `radial`", Quantity::length});
    v("along", along, About{"a direction of your own, for `by`"});
    v("by", by, About{"displacement along `along`, free across it", Quantity::length}.expression());
    v("affine", affine, About{"nine numbers, rows of F: the set goes to x = F X"});
    v("rotate", rotate, About{"rigid rotation of the set from its position at the start of the step"});
    v("translate", translate, About{"rigid translation, together with `rotate` or alone", Quantity::length});
    v("from", from,
      About{"x, y, z, radial, by count from the `reference` position or from the `start` of the step"}.one_of(
          {"reference", "start"}));
  }
};

/// Load on a surface (pressure) or on the nodes of a set (force). Reached linearly by the end of the step
/// unless it is a formula in s and t.
struct LoadSpec {
  std::string surface, set, region;
  std::optional<std::string> pressure;
  bool dead = false;
  Point direction{0, 0, 0};
  std::optional<Point> force;
  template <class V>
  void describe(V&& v) {
    v("surface", surface, About{"surface that carries `pressure`"});
    v("pressure", pressure,
      About{"pressure against the body; follows the deformed face", Quantity::stress}.expression());
    v("region", region, About{"region that `pressure` acts on, where the surface lies between two"});
    v("dead", dead, About{"pressure per reference area in a fixed direction instead"});
    v("direction", direction, About{"direction of a dead pressure; zero: against the reference normal"});
    v("set", set, About{"nodes that carry `force`"});
    v("force", force,
      About{"force on every node of the set; refused where `mesh.refine` gives the set more nodes",
            Quantity::force});
  }
};

/// One step of the history. What it does not mention stays as it was at the end of the step before.
struct StepSpec {
  std::string name;
  int increments = 1;
  std::map<std::string, std::string> pressures;
  std::vector<std::string> enclose;
  std::map<std::string, double> add;
  std::vector<DisplaceSpec> displace;
  std::vector<LoadSpec> loads;
  std::vector<MoveSpec> move;
  std::map<std::string, double> sew;
  std::vector<std::string> release;
  template <class V>
  void describe(V&& v) {
    v("name", name, About{"name in the records"});
    v("increments", increments,
      About{"increments to begin with; cut and grown as Newton finds it"}.between(1, 100000));
    v("pressures", pressures,
      About{"liquids whose pressure is given, and the pressure reached at the end of the step",
            Quantity::stress}
          .expression());
    v("enclose", enclose,
      About{"liquids enclosed from here on: V_i and P_i are taken at the start of the step"}.formerly(
          "couple"));
    v("add", add,
      About{"volume added to (or, negative, drained from) an enclosed liquid of the whole model in this step",
            Quantity::volume});
    v("displace", displace, About{"prescribed displacements"});
    v("loads", loads, About{"pressures on surfaces, forces on nodes"});
    v("move", move, About{"motions of rigid bodies"});
    v("sew", sew,
      About{"sutures, and the force per point of the whole model reached at the end of the step",
            Quantity::force});
    v("release", release,
      About{"sets whose prescribed displacement and surfaces or sets whose load ends here"});
  }
};

/// A figure to record at every increment. Areas, volumes and, but for `of`, forces and moments are of the
/// whole model, symmetry images included.
struct ProbeSpec {
  std::string name, kind, set, to, liquid, region, contact, body, suture,
      component = "magnitude", of = "whole", statistic = "mean", since, unit, label;
  double percentile = 100, tolerance = 0.1, within = 0, zone = 3, lens_power = 19.11, scale = 1;
  bool peak = false;
  template <class V>
  void describe(V&& v) {
    v("name", name, About{"column in history.csv and summary.json"}.needed());
    v("kind", kind,
      About{"what is recorded"}.needed().one_of({"displacement",
                                                 "position",
                                                 "distance",
                                                 "buckle_height",
                                                 "reaction",
                                                 "moment",
                                                 "pressure",
                                                 "volume",
                                                 "mises",
                                                 "volume_ratio",
                                                 "bar_force",
                                                 "contact_area",
                                                 "contact_force",
                                                 "contact_pressure",
                                                 "mean_contact_pressure",
                                                 "penetration",
                                                 "gap",
                                                 "closed_fraction",
                                                 "sealed_fraction",
                                                 "contact_fraction",
                                                 "body_force",
                                                 "body_moment",
                                                 "band_tension",
                                                 "suture_force",
                                                 "suture_mises",
                                                 "corneal_power",
                                                 "corneal_astigmatism",
                                                 "steep_meridian",
                                                 "refraction"}));
    v("set", set,
      About{"node set, surface or region (displacement, position, distance, reaction, moment; mises: cells "
            "that touch it; gap, closed_fraction: those of the contact's slave nodes; empty: all; "
            "sealed_fraction: nodes on an edge of the slave, such as a tear's rim; buckle_height: the crest; "
            "corneal_power, corneal_astigmatism, steep_meridian, refraction: the cornea's front)"});
    v("to", to,
      About{"the second set: distance is from the mean position of `set` to that of `to`; buckle_height: the "
            "wall beside the buckle; refraction: the retina's pole"});
    v("liquid", liquid, About{"the liquid (pressure, volume)"});
    v("region", region,
      About{"the region (mises, volume_ratio; refraction: the lens) or group of bars (bar_force); empty: "
            "all"});
    v("contact", contact,
      About{
          "the contact (contact_area, contact_force on its master, largest contact_pressure and "
          "penetration, mean_contact_pressure: force over area, gap, closed_fraction, sealed_fraction: share "
          "of an edge's length that is pressed, contact_fraction: share of the slave's area in contact)"});
    v("body", body,
      About{"the rigid body: what all contacts do to it (body_force, body_moment about the origin; "
            "band_tension: the hoop force with which its arcs balance that)"});
    v("suture", suture,
      About{"the suture (suture_force: of one string; suture_mises: cells that touch its bites)"});
    v("component", component,
      About{"of a vector; of forces, `radial` sums what points away from the z axis"}.one_of(
          {"x", "y", "z", "magnitude", "radial"}));
    v("of", of,
      About{"forces and moments: of the `whole`, symmetry images included (across a plane of symmetry the "
            "image cancels them), or of the drawn `part`; every further plane of symmetry then asks for "
            "a factor of 2 in `scale`: 4 for one side of an octant's plane"}
          .one_of({"whole", "part"}));
    v("statistic", statistic, About{"over a set: mean, max or min"}.one_of({"mean", "max", "min"}));
    v("percentile", percentile,
      About{"of the cells' Mises stress, by volume; 100 is the largest"}.between(0, 100));
    v("tolerance", tolerance,
      About{"a node with a smaller gap counts as closed", Quantity::length}.at_least(0));
    v("since", since,
      About{"a step: the figure is the change since its end, nothing before; displacements count from the "
            "positions there, node by node"});
    v("within", within,
      About{"suture_mises: the mean over the undeformed volume at most this far from the suture's points, in "
            "place of the percentile over the cells that touch them",
            Quantity::length}
          .at_least(0));
    v("zone", zone,
      About{"diameter about the z axis in which the cornea's curvature is measured; keratometers take 3 mm",
            Quantity::length}
          .positive());
    v("lens_power", lens_power,
      About{"refraction: power of the lens, D; 19.11 is Gullstrand's, relaxed"}.between(-100, 200));
    v("peak", peak,
      About{"the largest value of all increments so far in place of the present one; with `since`, of those "
            "after its end"});
    v("scale", scale, About{"multiplies the figure"});
    v("unit", unit, About{"unit of the record, such as mmHg; empty: mm, N, MPa"});
    v("label", label, About{"what the records call the unit instead, where `scale` changes it, such as D"});
  }
};

/// The whole of the physics.
struct Model {
  std::map<std::string, RegionSpec> regions;
  std::map<std::string, BarSpec> bars;
  std::map<std::string, LiquidSpec> liquids;
  std::vector<std::string> symmetry;
  std::optional<double> symmetry_tolerance;
  std::vector<FixSpec> fix;
  std::map<std::string, RigidBodySpec> rigid_bodies;
  std::vector<ContactSpec> contacts;
  std::map<std::string, SutureSpec> sutures;
  std::vector<StepSpec> steps;
  std::vector<ProbeSpec> probes;
  template <class V>
  void describe(V&& v) {
    v("regions", regions, About{"material of every region of the mesh, but for what `materials` says"});
    v("bars", bars, About{"groups of bars of the mesh"});
    v("liquids", liquids, About{"enclosed liquids"});
    v("symmetry", symmetry,
      About{"planes through the origin that cut the model: its nodes on them stay there, and figures "
            "report the whole"}
          .one_of({"x", "y", "z"}));
    v("symmetry_tolerance", symmetry_tolerance,
      About{"nodes that are nearer to a plane of symmetry are moved onto it (default: 1e-5 of the mesh's "
            "diagonal, and at most a "
            "fiftieth of a node's edges)",
            Quantity::length}
          .at_least(0));
    v("fix", fix, About{"directions that never move"});
    v("rigid_bodies", rigid_bodies, About{"bodies that the scene moves: band, tire, plane, ..."});
    v("contacts", contacts, About{"pairs of surfaces that may touch"});
    v("sutures", sutures, About{"strings that pull the tissue over a rigid body"});
    v("steps", steps, About{"the history"}.needed());
    v("probes", probes, About{"figures to record"});
  }
};

}  // namespace bulbus::inline problem
