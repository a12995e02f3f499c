#pragma once
#include <array>
#include <memory>

#include "core/element/block_csr.hpp"
#include "core/problem/problem.hpp"
#include "core/solve/layout.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/settings.hpp"

namespace bulbus::inline solve {

/// Two nodal vectors that keep nothing from one application to the next: 3 numbers per local node.
struct NodalWorkspace {
  std::vector<double> increment, force;
};

/// The unknowns of a problem on this rank.
Layout layout_of(const Problem& problem);

/// The tangent of the coupled problem in one state, a value, with the elements' augmentation γ B W Bᵀ and
/// what solvers and preconditioners need of it: liquids' columns, bodies' geometry, diagonal blocks, scaling.
/// Who keeps it shares it (SharedSystem); operators and preconditioners never change it or its problem. Of
/// the problem it takes mesh, constraints and liquids as they are in one step.
/// CoupledOperator is the matrix that it makes with an augmentation of the liquids.
class CoupledSystem {
 public:
  /// At a state of which `r` is the residual. `further` tangents are added to the problem's: on a coarser
  /// mesh, of what only the finer one has. Collective.
  CoupledSystem(const Problem& problem, const LinearSettings& settings, State state, const Residual& r,
                std::vector<std::shared_ptr<const TermTangent>> further = {});

  const Problem& problem() const { return problem_; }
  const SolidTangent& solid() const { return tangents_.solid; }
  const Linearisation& tangents() const { return tangents_; }
  /// visit() of what a coarser mesh does not make by itself: terms from floors above, and further tangents.
  void visit_added(const ContributionVisitor& visitor) const;
  const State& state() const { return *tangents_.state; }
  const Layout& layout() const { return layout_; }
  int size() const { return layout_.size(); }

  /// The rows of displacements and hexahedra without the liquids' part: (yu, yl) = A (xu, xl), with primal
  /// vectors and one number per hexahedron. Collective.
  void apply_tissue(std::span<const double> xu, std::span<const double> xl, std::span<double> yu,
                    std::span<double> yl) const;
  /// y = (K + γ B W Bᵀ) x on primal vectors. Collective.
  void apply_displacement(std::span<const double> x, std::span<double> y) const;
  /// force += what acts besides the solid: tangents of terms, and the liquids' pressures as followers. 3
  /// numbers per local node.
  void add_surface_action(std::span<const double> dx, std::span<double> force) const;
  /// The contributions of the same to the tangent.
  void visit_surface(const ContributionVisitor& visitor) const;
  /// The bodies' part of a force += geometry; unknowns that symmetry holds are identity rows. 6 per body on
  /// rank 0.
  void add_body_geometry(std::span<const double> x, std::span<double> y) const;
  /// Forces on local nodes, summed on owners, of increments of nodes and hexahedra; valid until the workspace
  /// is used again. `volume` takes the changes of the hexahedra that have an equation; `dlambda` and `volume`
  /// may be empty. Collective.
  std::span<double> nodal_action(std::span<const double> dx, std::span<const double> dlambda,
                                 std::span<double> volume) const;
  /// What all that applies this tangent shares, one after the other: not a part of the value.
  NodalWorkspace& workspace() const { return workspace_; }
  /// primal += factor · B λ
  void add_pressure_force(std::span<const double> lambda, double factor, std::span<double> primal) const;
  /// g of each liquid in primal form (empty where its pressure is given).
  const std::vector<std::vector<double>>& liquid_columns() const { return g_; }
  double compliance(int liquid) const { return compliance_[liquid]; }
  /// Are the liquids' pressures eliminated?
  bool eliminated() const { return settings_.formulation == Formulation::eliminated; }
  /// gᵀ Δu of every liquid. Collective.
  std::vector<double> liquid_fluxes(std::span<const double> primal) const;
  /// The same of nodal increments (3 per local node) that are prescribed. Collective.
  std::vector<double> prescribed_fluxes(std::span<const double> increments) const;

  /// (1 + γ) μ_e / V0_e: the diagonal part of Ŝ⁻¹ (formulation, section 9.5).
  std::vector<double> inverse_pressure_schur() const;
  /// V0_e / ((1 + γ) μ_e): minus the diagonal of a rigid hexahedron's row, whose pressure stays as it is.
  double rigid_compliance(int hex) const;
  /// 3×3 diagonal blocks of the displacement block, constrained directions on constrained_diagonal(); 9 per
  /// owned node. Made anew by every call, of all element matrices. Collective.
  std::vector<double> nodal_blocks() const;
  /// What constrained directions add to such blocks.
  void add_constrained_blocks(std::span<double> blocks) const;
  /// Of one node: its projector's complement times constrained_diagonal(), by rows.
  std::array<double, 9> constrained_block(int node) const;
  /// 6×6 block of every body, the same on every rank.
  const std::vector<std::array<double, 36>>& body_blocks() const { return body_blocks_; }
  double constrained_diagonal() const { return constrained_diagonal_; }
  /// What the rows of bodies (counted from the first body's) have beyond contributions: geometry and held
  /// unknowns.
  struct Entry {
    int row, column;
    double value;
  };
  std::vector<Entry> body_extra() const;
  /// Symmetric scaling s: every tolerance is on the Euclidean norm of s·r, free of units. Diagonal of s·A·s
  /// about 1.
  const std::vector<double>& scaling() const { return scaling_; }

  /// The factor of the augmentation γ B W Bᵀ of the displacement block, W = μ_e / V0_e.
  double gamma() const { return settings_.gamma; }
  std::size_t bytes() const;

 private:
  template <class Use>
  void for_each_term(Use use) const;
  void compute_body_geometry(const Residual& r);
  void compute_liquid_columns();
  std::vector<double> sum_blocks(std::vector<std::array<double, 36>>& bodies) const;
  void compute_blocks();
  void compute_scaling(const std::vector<double>& blocks);

  const Problem& problem_;
  LinearSettings settings_;
  Linearisation tangents_;
  std::vector<std::shared_ptr<const TermTangent>> further_;
  Layout layout_;
  std::vector<double> compliance_;  // of every liquid
  std::vector<std::vector<double>> g_;
  std::vector<double> scaling_;
  std::vector<std::array<double, 36>> body_blocks_;
  std::vector<Mat3<double>> body_geometry_;
  double constrained_diagonal_ = 1;
  std::unique_ptr<BlockCsr> assembled_;
  mutable NodalWorkspace workspace_;
};

/// How operators and preconditioners keep a linearisation.
using SharedSystem = std::shared_ptr<const CoupledSystem>;

}  // namespace bulbus::inline solve
