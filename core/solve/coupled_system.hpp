#pragma once
#include <memory>

#include "core/element/block_csr.hpp"
#include "core/problem/problem.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/settings.hpp"

namespace bulbus {

/// One rank's part of an unknown vector: [3 per owned node | 6 per rigid body, on rank 0 | 1 per hexahedron |
/// 1 per liquid, on rank 0].
struct Layout {
  int nodal = 0, bodies = 0, hexes = 0, liquids = 0;
  int primal() const { return nodal + bodies; }
  int size() const { return nodal + bodies + hexes + liquids; }
  template <class V>
  auto primal(V&& v) const {
    return std::span(v).subspan(0, primal());
  }
  template <class V>
  auto lambda(V&& v) const {
    return std::span(v).subspan(primal(), hexes);
  }
  template <class V>
  auto pressures(V&& v) const {
    return std::span(v).subspan(primal() + hexes, liquids);
  }
};

/// The bordered, augmented tangent in one state (formulation, section 3), applied without being formed:
///
///     [ K + γ B W Bᵀ + Σ ω g gᵀ     B    −(1 − ω V_i/K) g ]
///     [ Bᵀ                          0     0               ]
///     [ −gᵀ                         0    −V_i/K           ]
///
/// on free directions; held ones are identity rows times held_scale(). ω multiplies the third row into the
/// first: the liquids are augmented as the elements are, so that the displacement block stays regular where K
/// at fixed pressure is not. Eliminated formulation: ω = K/V_i, so that P leaves the first row. It leaves the
/// third too, whose unknown is then ΔP + (K/V_i) gᵀ Δu: a congruent system with the same inertia, whose dense
/// block (K/V_i) g gᵀ is what bordering saves. A liquid whose pressure is given keeps its row −V/K and has no
/// g; a hexahedron of a rigid region has a row of the same kind.
class CoupledSystem final : public LinearOperator {
 public:
  CoupledSystem(Problem& problem, const LinearSettings& settings);

  /// Takes the tangent at a state; `state` must stay where it is. `r` is its residual. Collective.
  void linearize(const State& state, const Residual& r);

  const Problem& problem() const { return problem_; }
  const State& state() const { return *state_; }
  const Layout& layout() const { return layout_; }
  int size() const override { return layout_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override;

  /// −residual − tangent · ū, for held increments ū still to be made (3 per local node), with the
  /// augmentation's part.
  std::vector<double> right_hand_side(const Residual& r, std::span<const double> held) const;

  /// y = (K + γ B W Bᵀ) x on primal vectors, without the liquids' ω.
  void apply_displacement(std::span<const double> x, std::span<double> y) const;
  /// force += what acts besides the solid: terms, and the liquids' pressures as followers. 3 numbers per
  /// local node.
  void add_surface_action(std::span<const double> dx, std::span<double> force) const;
  /// The bodies' part of a force += geometry; unknowns that symmetry holds are identity rows. 6 per body on
  /// rank 0.
  void add_body_geometry(std::span<const double> x, std::span<double> y) const;
  /// Two nodal vectors that keep nothing from one application to the next: 3 numbers per local node.
  struct Room {
    std::vector<double> dx, force;
  };
  Room& room() const { return room_; }
  /// primal += factor · B λ
  void add_pressure_force(std::span<const double> lambda, double factor, std::span<double> primal) const;
  /// g of each liquid in primal form (empty where its pressure is given).
  const std::vector<std::vector<double>>& liquid_columns() const { return g_; }
  double compliance(int liquid) const { return problem_.liquids()[liquid].compliance(); }
  /// Are the liquids' pressures eliminated?
  bool eliminated() const { return settings_.formulation == Formulation::eliminated; }
  /// ω per liquid, chosen by whoever knows gᵀ A⁻¹ g. Zero until then; K/V_i where pressures are eliminated.
  void set_liquid_augmentation(std::vector<double> omega) { omega_ = std::move(omega); }
  std::span<const double> liquid_augmentation() const { return omega_; }
  /// What a liquid's column and row keep of −g: 1 − ω V_i/K and 1, or nothing.
  double column_part(int liquid) const { return eliminated() ? 0 : 1 - omega_[liquid] * compliance(liquid); }
  double row_part() const { return eliminated() ? 0 : 1; }
  /// ΔP of every liquid, on every rank, from a solution of the system. Collective.
  std::vector<double> pressure_increments(std::span<const double> solution) const;

  /// (1 + γ) μ_e / V0_e: the inverse of the element-pressure Schur complement, diagonal part.
  std::vector<double> inverse_pressure_schur() const;
  /// V0_e / ((1 + γ) μ_e): minus the diagonal of a rigid hexahedron's row, whose pressure stays as it is.
  double rigid_compliance(int hex) const;
  /// 3×3 diagonal blocks of the displacement block, held directions on held_scale(); 9 per owned node. Made
  /// anew by every call, of all element matrices. Collective.
  std::vector<double> nodal_blocks() const;
  /// What held directions add to such blocks.
  void add_held_blocks(std::span<double> blocks) const;
  /// Of one node: its projector's complement times held_scale(), by rows.
  std::array<double, 9> held_block(int node) const;
  /// 6×6 block of every body, the same on every rank.
  const std::vector<std::array<double, 36>>& body_blocks() const { return body_blocks_; }
  double held_scale() const { return held_scale_; }
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
  std::span<double> nodal_action(std::span<const double> dx, std::span<const double> dlambda,
                                 std::span<double> volume) const;
  void take_liquid_columns();
  std::vector<double> liquid_fluxes(std::span<const double> primal) const;
  std::vector<double> sum_blocks(std::vector<std::array<double, 36>>& bodies) const;
  void take_blocks();
  void take_scaling(const std::vector<double>& blocks);

  Problem& problem_;
  LinearSettings settings_;
  Layout layout_;
  const State* state_ = nullptr;
  std::vector<std::vector<double>> g_;
  std::vector<double> omega_, scaling_;
  std::vector<std::array<double, 36>> body_blocks_;
  std::vector<Mat3<double>> body_geometry_;
  double held_scale_ = 1;
  std::unique_ptr<BlockCsr> assembled_;
  mutable Room room_;
};

}  // namespace bulbus
