#pragma once
#include <memory>
#include <optional>

#include "core/mesh/distributed/mesh_levels.hpp"
#include "core/problem/dof_map.hpp"
#include "core/problem/linearisation.hpp"
#include "core/problem/liquid.hpp"
#include "core/problem/loads.hpp"
#include "core/problem/model.hpp"
#include "core/problem/turned_radials.hpp"

namespace bulbus::inline problem {

/// The residual of the coupled system (formulation, section 3.1), before holds are projected out.
struct Residual {
  std::vector<double> force;            ///< A: 3 per local node, accumulated on the owners (N)
  std::vector<double> volume;           ///< B: V_e − V0_e per local hexahedron (mm³)
  std::vector<double> liquid;           ///< D per liquid, the same on every rank (mm³)
  std::vector<double> reference_force;  ///< per local node, accumulated: Σ |contributions| (N)
  /// On a rigid body, the same on every rank: force and moment along its free motions, their reference norms
  /// Σ |contributions| and Σ |arm| |contributions|, and the mean arm.
  struct Resultant {
    Vec3<double> force, moment;
    double reference_force, reference_moment, arm;
  };
  std::vector<Resultant> bodies;
};

/// How far a state is from equilibrium, relative and free of units.
struct EquilibriumError {
  double force =
      0;  ///< largest ‖A‖ / ‖contributions‖ of a region, force or moment of a rigid body, and which
  std::string region;
  double volume = 0;  ///< largest |V_e/V0_e − 1|
  double liquid = 0;  ///< largest |D| / V
  /// Of every region, force and moment of every body, and every liquid: what is missing over what rounding
  /// may leave of it.
  std::vector<double> above_rounding;
};

class EnclosedParts;

/// A sum of terms over one map from free unknowns to nodes: the physics of one model on one mesh, and nothing
/// of how it is solved. Made on all ranks together.
class Problem {
 public:
  /// Validates, partitions and builds. Throws InputError. Collective.
  Problem(const Mesh& mesh, const Model& model, const Comm& comm);
  /// On the finest mesh, with a coarser problem on each mesh below it.
  Problem(const MeshHierarchy& meshes, const Model& model, const Comm& comm);
  /// The same of a model that validate() lets pass on the base mesh; `levels` as from distribute_levels().
  /// Collective.
  Problem(std::vector<MeshLevel> levels, const Model& model);
  /// Gives its meshes back, for another model or other reference positions, and is of no use afterwards.
  std::vector<MeshLevel> take_levels() &&;

  const LocalMesh& mesh() const { return mesh_; }
  const Model& model() const { return model_; }
  const Comm& comm() const { return mesh_.comm; }
  const Solid& solid() const { return *solid_; }
  const DofMap& dofs() const { return *dofs_; }
  std::vector<Liquid>& liquids() { return liquids_; }
  const std::vector<Liquid>& liquids() const { return liquids_; }
  /// The same model on the mesh that this one refines, without the terms that were added; null for a mesh
  /// that refines none. It follows this problem through the steps.
  const Problem* coarser() const { return coarser_.get(); }
  const Prolongation& prolongation() const { return *level_.prolongation; }
  /// Nodal positions as they are at the coarser nodes, element pressures as means over the children.
  /// Collective.
  State coarsened(const State& state) const;
  /// Every term but the solid and the liquids.
  std::vector<std::shared_ptr<Term>> terms() const;
  const std::map<std::string, std::shared_ptr<BarsTerm>>& bars() const { return bars_; }
  /// Symmetry images: figures of the whole are this many times the model's (1, 2, 4, 8).
  int multiplicity() const { return multiplicity_; }
  bool symmetric() const;
  /// A term from a floor above; it acts, and hears of steps, after those added before it.
  void add(std::shared_ptr<Term> term) { added_.push_back(std::move(term)); }
  std::span<const std::shared_ptr<Term>> added() const { return added_; }
  /// Local nodes of a region, or of a set or surface that the model refers to as nodes. Throws InputError for
  /// others.
  const std::vector<int>& nodes_of(const std::string& set) const;

  State initial_state() const;
  /// Sets up loads, holds and liquids of a step from the state it starts in. Collective.
  void begin_step(int step, const State& start);
  /// Loads, given pressures and added liquid follow the part s of the step done.
  void set_progress(double s, State& state);
  /// Parts whose volume the constraints of this step fix.
  const EnclosedParts& enclosed() const { return *enclosed_; }
  /// What a person should know of the steps begun so far, those of a rehearsal included. The same on every
  /// rank.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Radial displacements of the steps begun so far, by set.
  const std::map<std::string, RadialHold>& radial_holds() const { return radial_holds_; }
  void end_step();
  /// Goes through the first steps without solving them: prescribed displacements are carried along, so that
  /// each step starts where the one before leaves its sets. Then it is as new, without the terms that were
  /// added. Throws InputError. Collective.
  void rehearse(int steps);
  /// What steps and increments have left behind, terms included. Collective.
  void serialize(Archive& archive);
  /// Goes back to the middle of a step, given its start and what `kept` gives; the problem must be new. `now`
  /// gets the pressures of that progress. Collective.
  void resume(int step, const State& start, double s, State& now, Archive& kept);
  /// Tells the terms by how much a Newton step with these tangents, of the same step, moves the local nodes.
  /// Collective.
  void predict(const Linearisation& tangents, std::span<const double> dx);
  /// Asks every term whether Newton, which has converged, has to go on. Collective.
  bool update_multipliers(const State& state);
  /// Why a state that Newton has converged to must not be accepted; empty: it may. Collective.
  std::string refusal(const State& state) const;
  double progress() const { return s_; }

  /// Collective.
  Residual residual(const State& state) const;
  EquilibriumError equilibrium_error(const Residual& r) const;
  /// `gamma` and `source`: see SolidTangent. Collective.
  Linearisation linearise(std::shared_ptr<const State> state, double gamma, StrainSource source) const;

 private:
  void begin(int step, const State& start, void (Term::*begin_term)(int, const State&));
  void build();
  void build_bodies_and_solid();
  void build_floors();
  void build_liquids();
  void build_bars();
  void hold_fixed();
  void require_free_elements() const;
  void find_enclosed(int step, const State& start);
  void add_displacement(const DisplaceSpec& spec, int step, int index, const State& start);
  std::string pressure_name(const LoadSpec& spec);
  void add_load(const LoadSpec& spec, int step, int index);
  void add_pressure(const LoadSpec& spec, const std::string& key, int step);
  void begin_liquids(const StepSpec& spec, int step, const State& start);
  void release(const StepSpec& spec, int step);
  void go_through(int steps);
  void renew();
  Residual::Resultant resultant(std::size_t body, const State& state, const Residual& r) const;
  int liquid_index(const std::string& name, const std::string& key) const;

  Model model_;
  MeshLevel level_;
  const LocalMesh& mesh_;  // of level_
  std::unique_ptr<Problem> coarser_;
  bool follows_ = false;  // a finer problem, which has been checked
  std::shared_ptr<const Solid> solid_;
  std::unique_ptr<DofMap> dofs_;
  std::shared_ptr<const EnclosedParts> enclosed_;
  std::vector<std::string> warnings_;
  std::map<std::string, RadialHold> radial_holds_;
  std::vector<Liquid> liquids_;
  std::map<std::string, std::shared_ptr<BarsTerm>> bars_;
  std::map<std::string, std::shared_ptr<Load>> loads_;
  std::vector<std::shared_ptr<Load>> fading_;  // in this step: others have taken their place
  std::vector<std::shared_ptr<Term>> added_;
  // Owned nodes of each solid region, but for those of rigid bodies and of much stiffer regions.
  std::vector<std::vector<int>> region_nodes_;
  std::vector<double> region_floor_, body_floor_;  // smallest force that counts, N
  int multiplicity_ = 1, step_ = -1;
  double s_ = 0;
};

}  // namespace bulbus::inline problem
