#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/parameters.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline problem {

/// What a scene says of rigid bodies that it moves itself, and of the sutures that run over them.

/// Meridian planes through an axis. Azimuth is in degrees from `zero` towards zero × axis: with the defaults
/// 0 is superior (+y), 90 lateral (+x), 180 inferior (−y).
struct Meridians {
  Point center{0, 0, 0}, axis{0, 0, 1}, zero{0, 1, 0};
  template <class V>
  void describe(V&& v) {
    v("center", center, About{"a point of the axis: axial positions count from here", Quantity::length});
    v("axis", axis, About{"direction of the axis"});
    v("zero", zero, About{"direction of azimuth 0; azimuth grows towards zero x axis"});
  }
};

/// Rigid rotation from the place at the start of a step.
struct RotationSpec {
  Point axis{0, 0, 1}, center{0, 0, 0};
  double angle = 0;
  template <class V>
  void describe(V&& v) {
    v("axis", axis, About{"direction of the axis"});
    v("center", center, About{"a point of the axis", Quantity::length});
    v("angle", angle, About{"angle reached at the end of the step", Quantity::angle}.needed());
  }
};

/// Edge of a plane of no given size in front of models that are smaller, mm.
inline constexpr double usual_plane = 50;

/// A square sheet; the body is behind it.
struct PlaneShape {
  Point point{0, 0, 0}, normal{0, 0, 1};
  std::optional<double> size;
  template <class V>
  void describe(V&& v) {
    v("point", point, About{"middle of the sheet", Quantity::length});
    v("normal", normal, About{"normal out of the body"});
    v("size", size,
      About{"edge; without it 50 mm, or as much as it takes to reach past the model", Quantity::length}
          .positive());
  }
};

struct SphereShape {
  Point center{0, 0, 0};
  double radius = 1;
  int facets = 16;
  template <class V>
  void describe(V&& v) {
    v("center", center, About{"centre", Quantity::length});
    v("radius", radius, About{"radius", Quantity::length}.positive());
    v("facets", facets, About{"facets along a quarter of a great circle"}.between(1, 1000));
  }
};

/// Its corners lie on the circle.
struct RodShape {
  Point center{0, 0, 0}, axis{0, 0, 1};
  double radius = 1, length = 10;
  int facets = 64;
  template <class V>
  void describe(V&& v) {
    v("center", center, About{"middle of the axis", Quantity::length});
    v("axis", axis, About{"direction of the axis"});
    v("radius", radius, About{"radius", Quantity::length}.positive());
    v("length", length, About{"length", Quantity::length}.positive());
    v("facets", facets, About{"facets around"}.between(3, 10000));
  }
};

/// The arc along which a section is swept, cut into parts that may move each its own way.
struct ArcSpec {
  Meridians meridians;
  double from = 0, to = 180;
  int parts = 1, facets = 24;
  bool caps = true;
  template <class V>
  void describe(V&& v) {
    meridians.describe(v);
    v("from", from, About{"azimuth of the first end, degrees"}.between(-360, 360));
    v("to", to, About{"azimuth of the last end, degrees"}.between(-360, 720));
    v("parts", parts, About{"arcs of equal length"}.between(1, 3600));
    v("facets", facets, About{"facets along each arc"}.between(1, 10000));
    v("caps", caps, About{"close the ends of the arcs"});
  }
};

/// A closed section swept about an axis.
struct SweptShape {
  std::vector<std::vector<double>> section;
  std::vector<double> at{0, 0};
  bool spline = false;
  int points = 64;
  ArcSpec arc;
  template <class V>
  void describe(V&& v) {
    v("section", section,
      About{"corners [axial, radial] in mm, counter-clockwise with the axis to the right and the radius up"}
          .needed());
    v("at", at, About{"[axial, radial] position of the section's origin, mm"});
    v("spline", spline, About{"join the corners by a closed cubic spline instead of straight lines"});
    v("points", points,
      About{"points that the spline is cut into, the corners among them"}.between(3, 10000));
    arc.describe(v);
  }
};

/// Encircling band: a rectangle with rounded edges.
struct BandShape {
  double width = 2, thickness = .75, edge_radius = .2, radius = 12, axial = 0, stiffness = 0;
  int edge_facets = 4;
  ArcSpec arc;
  template <class V>
  void describe(V&& v) {
    v("width", width, About{"width along the axis", Quantity::length}.positive());
    v("thickness", thickness, About{"radial thickness", Quantity::length}.positive());
    v("edge_radius", edge_radius, About{"radius of the four edges", Quantity::length}.positive());
    v("radius", radius, About{"radius of the inner face, as drawn", Quantity::length}.positive());
    v("axial", axial, About{"axial position of its middle", Quantity::length});
    v("stiffness", stiffness,
      About{"tension per strain, Young's modulus times section: the band is elastic, and its radius that at "
            "which its tension balances what it presses on; 0: it has the length that it is given",
            Quantity::force}
          .at_least(0));
    v("edge_facets", edge_facets, About{"facets around each edge"}.between(1, 1000));
    arc.describe(v);
  }
};

/// Silicone tire: inner face concave towards the sclera, outer face flat.
struct TireShape {
  double width = 7, crown = 2.75, edge_radius = .5, inner_radius_of_curvature = 12, radius = 12, axial = 0;
  int edge_facets = 4, face_facets = 12;
  ArcSpec arc{.to = 45};
  template <class V>
  void describe(V&& v) {
    v("width", width, About{"width along the axis", Quantity::length}.positive());
    v("crown", crown, About{"radial thickness in the middle of the section", Quantity::length}.positive());
    v("edge_radius", edge_radius, About{"radius of the four edges", Quantity::length}.positive());
    v("inner_radius_of_curvature", inner_radius_of_curvature,
      About{"radius of the inner face in the meridian plane", Quantity::length}.positive());
    v("radius", radius, About{"radius of the inner face's middle, as drawn", Quantity::length}.positive());
    v("axial", axial, About{"axial position of its middle", Quantity::length});
    v("edge_facets", edge_facets, About{"facets around each edge"}.between(1, 1000));
    v("face_facets", face_facets, About{"facets across the inner face"}.between(1, 1000));
    arc.describe(v);
  }
};

struct BodyFile {
  std::string path, surface;
  double scale = 1;
  template <class V>
  void describe(V&& v) {
    v("path", path, About{"STL file (text or binary), or Gmsh file of 8-node hexahedra"}.needed());
    v("surface", surface, About{"physical surface of the Gmsh file (.msh)"});
    v("scale", scale, About{"mm per unit of length of the file"}.positive());
  }
};

/// A rigid body that the scene moves: exactly one shape.
struct RigidBodySpec {
  std::optional<PlaneShape> plane;
  std::optional<SphereShape> sphere;
  std::optional<RodShape> cylinder;
  std::optional<SweptShape> swept;
  std::optional<BandShape> band;
  std::optional<TireShape> tire;
  std::optional<BodyFile> file;
  Point direction{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("plane", plane, About{"a square sheet"});
    v("sphere", sphere, About{"a ball"});
    v("cylinder", cylinder, About{"a round rod"});
    v("swept", swept, About{"a section swept about an axis"});
    v("band", band, About{"an encircling band"});
    v("tire", tire, About{"a silicone tire"});
    v("file", file, About{"a surface from a file"});
    v("direction", direction,
      About{"direction of `close`; zero: against the radius of each arc's middle, along a plane's normal"});
  }
  /// Throws InputError unless exactly one shape is given.
  void validate() const;
};

/// Motion of a rigid body over a step, reached linearly by its end: all parts turn together, shift together
/// and close each along its own direction, as that was at the start of the step. A body that a step does not
/// move stays.
struct MoveSpec {
  std::string body, from = "here";
  Point translate{0, 0, 0};
  std::optional<RotationSpec> rotate;
  double close = 0, shorten = 0;
  template <class V>
  void describe(V&& v) {
    v("body", body, About{"the rigid body"}.needed());
    v("translate", translate, About{"shift reached at the end of the step", Quantity::length});
    v("rotate", rotate, About{"rigid rotation of all parts together"});
    v("close", close,
      About{"displacement of every part along its own direction (`direction` of the body): of a band or a "
            "tire towards its axis; negative: back",
            Quantity::length});
    v("shorten", shorten,
      About{"in place of `close`: by how much the whole circumference is shortened, which closes every part "
            "by 1/(2 pi) of it, parts of a wide angle 2h by h/sin(h) more",
            Quantity::length});
    v("from", from,
      About{"the motion counts from where the body is (`here`), or from where each part, approaching along "
            "its direction, first touches a slave of its contacts (`touch`)"}
          .one_of({"here", "touch"}));
  }
};

/// Strings that pull points of the tissue along the tangents to the outline of a body.
struct SutureSpec {
  struct Pair {
    double azimuth = 0, spacing = 8.9, axial = 0;
    template <class V>
    void describe(V&& v) {
      v("azimuth", azimuth, About{"azimuth of the meridian, degrees"}.between(-360, 360));
      v("spacing", spacing,
        About{"length of the undeformed meridian between the two points", Quantity::length}.positive());
      v("axial", axial, About{"axial position of the middle between them", Quantity::length});
    }
  };
  std::string body, surface;
  std::optional<Pair> pair;
  std::vector<Point> points;
  std::vector<std::string> sets;
  Meridians meridians;
  Point generator{0, 0, 0};
  double bite = 1;
  bool follow = true;
  template <class V>
  void describe(V&& v) {
    v("body", body, About{"the rigid body whose outline the string runs over"}.needed());
    v("surface", surface, About{"surface of the mesh that `pair` and `points` lie on"});
    v("pair", pair, About{"two points on a meridian"});
    v("points", points,
      About{"one or two points on the surface, off by less than the length of one of its faces",
            Quantity::length});
    v("sets", sets, About{"one or two node sets: each is one point, its nodes share the force equally"});
    v("bite", bite,
      About{"area over which the force of a point is spread; 0: at the point alone", Quantity::area}.at_least(
          0));
    v("follow", follow,
      About{"the direction follows the tissue within an increment; `false`: that of the last increment "
            "stays, so that "
            "results depend on the number of increments"});
    v("generator", generator,
      About{"normal of the outline's plane; zero: the meridian plane through the point"});
    meridians.describe(v);
  }
  /// Throws InputError unless the points are given in exactly one way.
  void validate() const;
};

}  // namespace bulbus::inline problem
