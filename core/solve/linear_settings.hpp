#pragma once
#include <optional>
#include <string>

#include "core/base/parameters.hpp"
#include "core/solve/choices.hpp"

namespace bulbus::inline solve {

/// The Chebyshev smoother of a preconditioner of the displacement block.
struct SmootherSettings {
  int degree;
  double smoothing_range;
  template <class V>
  void describe(V&& v) {
    v("degree", degree, About{"degree of the Chebyshev smoother"}.between(1, 20));
    v("smoothing_range", smoothing_range,
      About{"the Chebyshev smoother damps eigenvalues above this part of the largest"}.between(1e-3, 0.9));
  }
};

/// Aggregation as a preconditioner of the displacement block.
struct AggregationSettings : SmootherSettings {
  int nodes = 16, factorised = 8000;
  AggregationSettings() : SmootherSettings{16, 0.02} {}
  template <class V>
  void describe(V&& v) {
    v("nodes", nodes, About{"nodes of an aggregate"}.between(8, 1000));
    v("factorised", factorised,
      About{"most unknowns of a coarse matrix that is factorised; a larger one is aggregated again, and "
            "factorised only after a solve that failed"}
          .between(100, 10000000));
    SmootherSettings::describe(v);
  }
};

/// Geometric multigrid as a preconditioner of the displacement block.
struct MultigridSettings : SmootherSettings {
  Cycle cycle = Cycle::v;
  MultigridSettings() : SmootherSettings{12, 0.02} {}
  template <class V>
  void describe(V&& v) {
    v("cycle", cycle, About{"V-cycle or W-cycle"}.formerly("visits"));
    SmootherSettings::describe(v);
  }
};

/// The Schur-complement correction: the part of the element pressures' preconditioner that knows their
/// checkerboard modes, too expensive for short solves.
struct PressureSettings {
  int after = 6;
  std::optional<int> degree;
  double weight = 0.15;
  template <class V>
  void describe(V&& v) {
    v("after", after,
      About{"Krylov iterations before the correction; solves after one that waited without effect, and those "
            "for more digits than two thirds of it (6: to less than 1e-4), have it from the start"}
          .between(0, 100000));
    v("degree", degree,
      About{"degree of the Chebyshev polynomial that inverts the Schur complement of the finest checkerboard "
            "modes; "
            "0: from the mesh"}
          .between(0, 1000)
          .automatic());
    v("weight", weight,
      About{"weight of the correction beside the scaled diagonal; on refined meshes the default is 0.3"}
          .between(0, 1));
  }
};

/// The linear solver: GMRES on the augmented system, or a sparse direct solver on the plain one.
struct LinearSettings {
  Method method = Method::iterative;
  Direct direct = Direct::mumps;
  Ordering ordering = Ordering::scotch;
  Refinement refinement = Refinement::none;
  Formulation formulation = Formulation::bordered;
  Displacement displacement = Displacement::automatic;
  TangentStorage op = TangentStorage::recompute;
  Precision smoothing = Precision::single;
  Fallback fallback = Fallback::direct;
  double gamma = 5, smoothing_range = 0.05, reuse = 0, coarse_change = 0.1;
  int restart = 40, max_iterations = 400, degree = 6, aggregates = 150;
  AggregationSettings aggregation;
  MultigridSettings multigrid;
  PressureSettings pressures;
  std::optional<double> memory_limit;
  std::string dump;
  bool record_krylov = false, record_spectrum = false;
  /// Gives its default to what depends on how often the mesh is refined.
  void take_mesh(int refinements);
  /// The preconditioner of the displacement block; `automatic` is multigrid where the mesh is refined,
  /// aggregation elsewhere.
  Displacement displacement_on(bool refined) const;
  /// Are the coarser meshes of a refined one of any use?
  bool wants_hierarchy() const;
  /// MB over all ranks that a run may need: the memory limit, else what this machine has.
  double allowed_mb() const;
  template <class V>
  void describe(V&& v) {
    describe_choices(v);
    describe_direct(v);
    describe_gmres(v);
    describe_preconditioners(v);
    describe_records(v);
  }

 private:
  // What acts under which choice is what KrylovSolver and DisplacementFactory read.
  static About of_gmres(const About& about) {
    return about.only_with("solver.linear.method", Method::iterative);
  }
  template <class... D>
  static About of_displacement(const About& about, D... by) {
    return of_gmres(about.expert()).only_with("solver.linear.displacement", by...);
  }
  static About of_direct(const About& about) {
    return about.expert().only_with("solver.linear.method", Method::direct);
  }
  static About of_mumps(const About& about) {
    return of_direct(about).only_with("solver.linear.direct", Direct::mumps);
  }
  template <class V>
  void describe_choices(V& v);
  template <class V>
  void describe_direct(V& v);
  template <class V>
  void describe_gmres(V& v);
  template <class V>
  void describe_preconditioners(V& v);
  template <class V>
  void describe_records(V& v);
};

template <class V>
void LinearSettings::describe_choices(V& v) {
  v("method", method, About{"GMRES or a sparse direct solver, MUMPS unless `direct` names another"});
  v("formulation", formulation,
    About{"liquids of k wet nodes: bordered, P an unknown and 2*3k+1 numbers; or eliminated, for comparison: "
          "(3k)^2 numbers K/V_i g g^T, which the iterative solver applies as a product"}
        .expert());
  v("displacement", displacement,
    of_gmres({"preconditioner of the displacement block; auto: multigrid where the mesh is refined, "
              "aggregation elsewhere, both Bulbus's own. hypre's BoomerAMG, for comparison: boomeramg on the "
              "whole block, component by component; boomeramg_nodal, node by node with the rotations; "
              "scalar_amg on xx, yy and zz; hybrid, the same between smoothers, with rigid-body modes"}));
  v("operator", op,
    About{"tangent: all recomputed, strain cached in float, or assembled 3x3 blocks"}.expert());
  // not of GMRES alone: beside the direct solver either word is true
  v("fallback", fallback,
    About{"what solves a system on which GMRES stagnates or fails; direct: MUMPS, as long as the memory "
          "suffices; none: the increment is cut, and what MUMPS does for systems of up to 2,000 unknowns, "
          "counting negative pivots and a second try before a cut, is left out"});
  v("memory_limit", memory_limit,
    About{"MB over all ranks that a run may need: more is refused; 0: the memory of one machine"}
        .at_least(0)
        .automatic());
}

template <class V>
void LinearSettings::describe_direct(V& v) {
  v("direct", direct,
    of_direct(
        {"the direct solver. L D L^T with its number of negative pivots: mumps. L U, for comparison: "
         "superlu_dist, on any number of ranks; umfpack, on one, if the program was built with it; eigen, "
         "on one, up to 20,000 unknowns"}));
  v("ordering", ordering, of_mumps({"order of elimination in MUMPS; auto: its own choice"}));
  v("refinement", refinement,
    of_direct({"gmres: solutions are those of GMRES, preconditioned by the factors, to the tolerance that "
               "Newton's iteration asks for; negative pivots are not counted then"}));
}

template <class V>
void LinearSettings::describe_gmres(V& v) {
  v("gamma", gamma,
    of_gmres(
        About{"augmentation of the incompressibility in the linear system; on refined meshes the default "
              "is 12"}
            .between(0, 1e4)
            .expert()));
  v("max_iterations", max_iterations,
    of_gmres(About{"Krylov iterations before the increment is cut"}.between(1, 100000)));
  v("restart", restart, of_gmres(About{"Krylov basis before a restart"}.between(2, 500).expert()));
  v("reuse", reuse,
    of_gmres(About{"a preconditioner is kept for later linearisations of its step as long as these take no "
                   "more than so many times the Krylov iterations per digit of its own; 0: each has its own"}
                 .between(0, 100)
                 .expert()));
}

template <class V>
void LinearSettings::describe_preconditioners(V& v) {
  using D = Displacement;
  v("smoothing", smoothing,
    of_displacement({"precision of smoother and factors in the preconditioner of the displacement block"},
                    D::aggregation, D::multigrid, D::hybrid));
  v("coarse_change", coarse_change,
    of_displacement(
        About{"factors of the coarsest matrix are kept for later linearisations of their step as long as no "
              "row of it has changed by more than this part and solves are easy: at most four Krylov "
              "iterations per digit, and twice those of their own solve; 0: each has its own"}
            .between(0, 1),
        D::aggregation, D::multigrid));
  v("aggregation", aggregation, of_displacement({"aggregation, for meshes of any kind"}, D::aggregation));
  v("multigrid", multigrid, of_displacement({"multigrid on the refined meshes"}, D::multigrid));
  v("pressures", pressures,
    of_displacement({"Schur-complement correction for checkerboard modes of element pressures"},
                    D::aggregation, D::multigrid));
  v("degree", degree,
    of_displacement(About{"degree of the hybrid's Chebyshev smoother"}.between(1, 20), D::hybrid));
  v("smoothing_range", smoothing_range,
    of_displacement(
        About{"the hybrid's Chebyshev smoother damps eigenvalues above this part of the largest"}.between(
            1e-3, 0.9),
        D::hybrid));
  v("aggregates", aggregates,
    of_displacement(About{"aggregates whose rigid motions correct the hybrid; 0: none"}.between(0, 2000),
                    D::hybrid));
}

template <class V>
void LinearSettings::describe_records(V& v) {
  v("dump", dump,
    About{"folder, within that of the results, that receives every linear system with its right-hand side "
          "(HDF5); empty: none"}
        .debug());
  v("record_krylov", record_krylov,
    of_gmres(About{"write the residual of every Krylov iteration, block by block, to krylov.csv"}.debug()));
  v("record_spectrum", record_spectrum,
    of_gmres(About{"write eigenvalue estimates of every preconditioned system to krylov.csv"}.debug()));
}

/// Of the tangent that is solved with: the direct solver factorises it as it is, augmentation would only
/// fill it.
inline LinearSettings system_settings(LinearSettings settings) {
  if (settings.method == Method::direct) settings.gamma = 0;
  return settings;
}

}  // namespace bulbus::inline solve
