#pragma once
#include <functional>
#include <optional>

#include "contact/law/block_tangent.hpp"
#include "contact/law/contact_figures.hpp"
#include "contact/law/pressure_law.hpp"
#include "contact/search/clearances.hpp"
#include "contact/search/position_codes.hpp"
#include "contact/search/sweep.hpp"
#include "contact/surfaces/master.hpp"
#include "contact/surfaces/normal_projection.hpp"
#include "contact/surfaces/rounded_edge.hpp"
#include "contact/surfaces/slave_points.hpp"
#include "core/base/parallel.hpp"
#include "core/problem/spec/contact_spec.hpp"
#include "core/problem/term.hpp"

namespace bulbus::inline contact {

/// The two sides as this rank holds them.
struct ContactSides {
  std::span<const double> X;  ///< reference positions of the local nodes
  int owned;                  ///< the first ones are owned
  std::span<const Quad>
      slave;  ///< local nodes, at least all faces that touch an owned node; normals outwards
  Master master;
  std::span<const std::string> symmetry;  ///< planes "x", "y", "z" on which that coordinate is 0
};

/// Taken where the specification says 0.
struct ContactDefaults {
  double penalty;      ///< α_A, MPa/mm; 0: none
  double depth;        ///< mm
  double shear = 0;    ///< initial shear modulus of the softer side, MPa; 0: not known
  double modulus = 0;  ///< E* of both sides, 1/E* = Σ (1 − ν²)/E, MPa; 0: not known
  double reach = 0;    ///< of the search, mm: larger than any motion of an increment. 0: twice the depth
};

/// Frictionless contact of one surface, at its nodes or at points of its faces, with a master (formulation,
/// section 5). Per point and master piece, with the reference tributary area A0, the gap G and the trial
/// pressure τ = p − α_A G:
///     potential A0/(2 α_A) max(0, τ)²,  residual −A0 max(0, τ) D,  tangent A0 (α_A D Dᵀ − max(0, τ) H)
/// The multiplier p is 0 unless the specification gives a tolerance. Nodes that both surfaces share make no
/// pairs; a point's gradient D is shared out to the nodes that carry it.
///
/// D follows the normals of the master's nodes (CurvedGap, NormalProjection), so that forces go on from facet
/// to facet; those between deformable bodies balance but have no potential. H of a
/// rigid body is taken once a pressure was predicted, where the body is hollow at once; that of a deformable
/// master once pressure and prediction agree within a factor of two, between 0.01 and 1 shear moduli.
///
/// Active-set update: Newton's method is a primal-dual active set method (Hintermüller, Ito and Kunisch, SIAM
/// J. Optim. 13, 2002; Hüeber and Wohlmuth, CMAME 194, 2005): a pair whose pressure the last linear solution
/// predicts to be positive stays active where the curved way of the nodes has opened it (still_active). At
/// convergence no pair is in tension, and the law above is the one that is balanced.
///
/// Pairs are a function of the state, of the rigid body's positions, of what commit() has left and, within an
/// increment, of predict().
class ContactTerm final : public Term {
 public:
  ContactTerm(const ContactSpec& spec, const ContactDefaults& defaults, const ContactSides& sides,
              const Comm& comm);

  void add_residual(const State& state, std::span<double> force,
                    std::span<double> reference_force) const override;
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>& state) const override;

  /// The force of a deformable master has no potential.
  bool symmetric() const override { return master_.rigid(); }
  void begin_step(int step, const State& state) override;
  /// Without the search for pairs, which is long and ends in nothing where the step is not solved.
  void pass_step(int step, const State& start) override;
  void predict(const TermTangent& tangent, std::span<const double> dx) override;
  bool update_multipliers(const State& state) override { return !(settled_ = !unsettled(state)); }
  void set_progress(double s) override;
  void freeze() override;
  void commit(const State& state) override;
  void roll_back() override;
  void serialize(Archive& archive) override;
  std::string refusal(const State& state) const override;

  /// Did the last update_multipliers() leave all as it was?
  bool settled() const { return settled_; }
  /// The rigid master has been moved within the increment: the active set is looked at anew.
  void reopen() { retried_ = false; }

  /// N·mm
  double potential(const State& state) const;
  /// Collective.
  ContactFigures figures(const State& state) const;
  /// In the order of slave().nodes(); gaps larger than `farthest` (mm; 0: the search's reach) are infinite.
  std::vector<ContactNode> nodes(const State& state, double farthest = 0) const;
  /// Gives `nodes` whose gap is infinite the distance to the master, however far.
  void measure_far(const State& state, std::span<ContactNode> nodes) const;
  /// The owned nodes that a contact of nodes presses on.
  std::vector<int> active_nodes(const State& state) const;
  /// Largest, mm, on this rank.
  double penetration(const State& state) const { return penetration(found(state)); }
  const SlaveSurface& slave() const { return slave_; }
  const SlavePoints& points() const { return points_; }
  const Augmentation& augmentation() const { return augmentation_; }
  const ContactMemory& memory() const { return committed_; }
  int searches() const { return search_.searches(); }
  /// Where a run goes on: the ways of points begin in this state.
  void rests(const State& state) const;

  /// Current positions of the slave points, their chordal offset added along the normal; 3 each, mm.
  std::vector<double> outermost(const State& state) const { return outermost(state.x, shape(state.x)); }
  /// Of the slave points, out of the slave; unit, or zero where it has none.
  std::vector<Vec3<double>> normals(const State& state) const { return shape(state.x).normals; }
  /// Points farther inside than `tolerance` (mm) and nearer than the reach, whatever the depth allowed.
  Overlap overlaps(const State& start, double tolerance) const;
  /// Points that are inside by more than is allowed (mm), as a function of a point and its area (mm²).
  Overlap inside(const State& state,
                 const std::function<double(const SlavePoints::Point&, double)>& allowed) const;
  /// Active points whose surface looks the way the master does, as if they had slipped around it.
  Overlap behind(const State& state) const;
  /// Lets the gap count from where each node is at the start; that fades linearly over the step that follows.
  void resolve(const State& start);

 private:
  static constexpr int most_releases = 3;        // of a pair; then it is active no longer than the law says
  static constexpr double farthest_search = 16;  // in reaches; a point that moves farther may miss a contact
  struct Touch {
    int point, slot, triangle;
    Pair pair;
    Mat3<double> bend{};                      // of a curved rigid body
    std::optional<NormalProjection> along{};  // onto a deformable master
  };
  struct Found {
    std::vector<double> key;     // where the surfaces are
    std::vector<Touch> touches;  // by slave point, then piece, then face
    SlaveSurface::Shape shape;
    double motion = 0;  // of a point relative to the master since the last increment ended, at most, mm
  };
  // D = ∂G/∂x of the nodes of a pair: what carries its slave point, then the corners of a deformable master
  struct PairGradient {
    int size = 0;
    std::array<int, 7> nodes;
    std::array<Vec3<double>, 7> D;
  };
  // How the pressure of an active pair changes with its nodes: δp = −stiffness Σ D·δx
  struct PressureRate {
    int slot;
    double pressure, stiffness;  // MPa, MPa/mm
    PairGradient gradient;
  };
  struct Tangent final : TermTangent {
    void add_action(std::span<const double> dx, std::span<double> force) const override {
      blocks.add_action(dx, force);
    }
    void visit(const ContributionVisitor& visitor) const override { blocks.visit(visitor); }
    double solve_tolerance() const override { return tolerance; }
    BlockTangent blocks;
    std::vector<PressureRate> rates;  // of the active pairs
    double tolerance = 1;             // of linear solves
  };
  // Where slave points and corners of the master were when the last increment ended; empty: not known.
  struct IncrementStart {
    std::vector<double> points, places;
    bool resumed = false;  // the points are where the next search finds them
    double deepest = 0;    // penetration, mm
  };

  std::vector<double> surfaces(const State& state) const;
  const Found& found(const State& state) const;
  SlaveSurface::Shape shape(std::span<const double> x) const;
  std::vector<double> outermost(std::span<const double> x, const SlaveSurface::Shape& shape) const;
  PairGradient gradient(const State& state, const Touch& touch) const;
  void add_tangent_along(const MasterSurface& master, const Touch& touch, const ContactPressure& pressure,
                         BlockTangent& blocks) const;
  double cover(const Touch& touch) const;
  double area(const Touch& touch) const;
  double area_of_points(const Found& found) const;
  double area_of_faces(const State& state, const Found& found) const;
  double least_area(const Found& found) const;
  void add_tangent(const Touch& touch, const PairGradient& gradient, double a, double b,
                   BlockTangent& blocks) const;
  enum class Search { whole, with_history, near_last };
  Found find(const State& state, const SearchLimits& limits, Search how) const;
  void add_touches(const MasterSurface& master, const Vec3<double>& x, int point, int slot, int triangle,
                   std::vector<Touch>& touches) const;
  int slots() const { return points_.size() * master_.pieces(); }
  std::vector<FaceGap> faces_at_edge(const MasterSurface& master, const Vec3<double>& x, int triangle) const;
  Touch touch(const MasterSurface& master, const Vec3<double>& x, int point, int slot, int triangle) const;
  int closest_triangle(const MasterSurface& master, const Vec3<double>& x, int triangle) const;
  bool look_back(std::span<const double> points, std::span<const double> places) const;
  void follow(const MasterSurface& master, double motion, const Way& way, const Vec3<double>& N, int start,
              std::span<const int> candidates, Selection& chosen) const;
  bool idle(int point) const;
  bool beside(const Touch& touch) const;
  double gap(const Touch& touch) const;
  ContactPressure pressure(const Touch& touch) const;
  double penetration(const Found& found) const;
  /// The points of this rank that count, in a state in which `found` was found.
  Overlap overlap_of(const Found& found, const State& state,
                     const std::function<bool(const Touch&)>& counts) const;
  double violation(const Found& found) const;
  double needed_tolerance(double highest) const;
  bool unsettled(const State& state);
  double updated(const Touch& touch) const;
  bool released(const Found& found);
  bool set_changed(const Found& found);
  void begin_increment();
  void leave(const State& state);
  void recall(std::span<const double> rows);

  std::string name_;
  Comm comm_;
  Master master_;
  SlaveSurface slave_;
  SlavePoints points_;
  int owned_;
  std::vector<double> area0_;
  double penalty_, stiffness_ /* in defaults */, tolerance_, edge_radius_, shear_, modulus_;
  double fade_ = 1;
  mutable IncrementStart start_;
  SearchLimits limits_;
  ContactMemory committed_, current_;
  Augmentation augmentation_;

  std::vector<double> predicted_;  // pressure of every slot after the last Newton step, MPa; 0: not active
  std::vector<int> active_;        // slots with which that step was found
  bool stepped_ = false, retried_ = false,
       settled_ = true;        // in this increment; at convergence, with another active set
  std::vector<int> releases_;  // of every slot from tension in this increment

  mutable GlobalSearch search_;
  mutable Clearances clearances_;
  double rise_ = 0;  // of a curved master above its triangles, mm
  mutable Found found_;
};

}  // namespace bulbus::inline contact
