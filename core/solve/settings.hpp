#pragma once
#include <string>

#include "core/base/parameters.hpp"

namespace bulbus {

/// The Chebyshev smoother of a preconditioner of the displacement block.
struct SmootherSettings {
  int degree;
  double smoothed_part;
  template <class V>
  void describe(V&& v) {
    v("degree", degree, About{"degree of the Chebyshev smoother"}.between(1, 20));
    v("smoothed_part", smoothed_part,
      About{"the Chebyshev smoother damps eigenvalues above this part of the largest"}.between(1e-3, 0.9));
  }
};

/// Aggregation as a preconditioner of the displacement block.
struct AggregationSettings : SmootherSettings {
  int nodes = 16;
  AggregationSettings() : SmootherSettings{16, 0.02} {}
  template <class V>
  void describe(V&& v) {
    v("nodes", nodes, About{"nodes of an aggregate"}.between(8, 1000));
    SmootherSettings::describe(v);
  }
};

/// Geometric multigrid as a preconditioner of the displacement block.
struct MultigridSettings : SmootherSettings {
  int visits = 1;
  MultigridSettings() : SmootherSettings{12, 0.02} {}
  template <class V>
  void describe(V&& v) {
    v("visits", visits,
      About{"cycles on every coarser refined level for one on the next finer: 1: V-cycle, 2: W-cycle"}
          .between(1, 2));
    SmootherSettings::describe(v);
  }
};

/// The part of the element pressures' preconditioner that knows their weak patterns: too dear for easy
/// solves.
struct PressureSettings {
  int after = 6, degree = 0;
  double weight = 0.15;
  template <class V>
  void describe(V&& v) {
    v("after", after,
      About{"Krylov iterations after which that part is taken up; solves after one that waited in vain, and "
            "those for more digits than two thirds "
            "of it (6: to less than 1e-4), take it up at once"}
          .between(0, 100000));
    v("degree", degree,
      About{"degree of the polynomial that inverts what weak patterns meet, those of the finest hexahedra; "
            "0: from the mesh"}
          .between(0, 1000));
    v("weight", weight,
      About{"weight of what weak patterns meet beside what knows strains only; on refined meshes the default "
            "is 0.3"}
          .between(0, 1));
  }
};

/// The linear solver: GMRES on the augmented system, or MUMPS on the plain one.
struct LinearSettings {
  std::string method = "iterative";
  std::string formulation = "bordered";
  std::string displacement = "auto";
  std::string op = "recompute";
  std::string smoothing = "single";
  std::string fallback = "direct";
  double gamma = 5, smoothed_part = 0.05, reuse = 0, coarse_change = 0.1;
  int restart = 40, max_iterations = 400, degree = 6, aggregates = 150;
  AggregationSettings aggregation;
  MultigridSettings multigrid;
  PressureSettings pressures;
  double memory_limit = 0;
  std::string dump;
  bool record_krylov = false, record_spectrum = false;
  /// Gives its default to what depends on how often the mesh is refined.
  void take_mesh(int refinements);
  /// Are the coarser meshes of a refined one of any use?
  bool wants_hierarchy() const {
    return method == "iterative" && (displacement == "auto" || displacement == "multigrid");
  }
  template <class V>
  void describe(V&& v) {
    v("method", method, About{"GMRES or the direct solver MUMPS"}.one_of({"iterative", "direct"}));
    v("formulation", formulation,
      About{"liquids of k wet nodes: bordered, P an unknown and 2*3k+1 numbers; or eliminated, for "
            "comparison: (3k)^2 numbers K/V_i g g^T, "
            "which the iterative solver applies as a product"}
          .one_of({"bordered", "eliminated"}));
    v("displacement", displacement,
      About{"preconditioner of the displacement block; auto: multigrid where the mesh is refined, "
            "aggregation elsewhere"}
          .one_of({"auto", "aggregation", "multigrid", "hybrid", "scalar_amg", "boomeramg", "boomeramg_nodal",
                   "jacobi", "exact"}));
    v("operator", op,
      About{"tangent: all recomputed, strain cached in float, or assembled 3x3 blocks"}.one_of(
          {"recompute", "cache", "assembled"}));
    v("gamma", gamma,
      About{"augmentation of the incompressibility in the linear system; on refined meshes the default is 12"}
          .between(0, 1e4));
    v("smoothing", smoothing,
      About{"precision of smoother and factors in the preconditioner of the displacement block"}.one_of(
          {"single", "double"}));
    v("reuse", reuse,
      About{"a preconditioner is kept for later linearisations of its step as long as these take no more "
            "than so many times the Krylov "
            "iterations per digit of its own; 0: each has its own"}
          .between(0, 100));
    v("coarse_change", coarse_change,
      About{"factors of the coarsest matrix are kept for later linearisations of their step as long as no "
            "row of it has changed by more than this "
            "part and solves are easy: at most four Krylov iterations per digit, and twice those of their "
            "own solve; 0: each has its own"}
          .between(0, 1));
    v("fallback", fallback,
      About{"what solves a system on which GMRES stagnates or fails; direct: MUMPS, as long as the memory "
            "suffices; none: the increment is cut"}
          .one_of({"direct", "none"}));
    v("restart", restart, About{"Krylov basis before a restart"}.between(2, 500));
    v("max_iterations", max_iterations,
      About{"Krylov iterations before the increment is cut"}.between(1, 100000));
    v("degree", degree, About{"degree of the Chebyshev smoother"}.between(1, 20));
    v("smoothed_part", smoothed_part,
      About{"the Chebyshev smoother damps eigenvalues above this part of the largest"}.between(1e-3, 0.9));
    v("aggregates", aggregates,
      About{"aggregates whose rigid motions correct the hybrid; 0: none"}.between(0, 2000));
    v("aggregation", aggregation, About{"aggregation, for meshes of any kind"});
    v("multigrid", multigrid, About{"multigrid on the refined meshes"});
    v("pressures", pressures, About{"weak patterns of element pressures, with aggregation and multigrid"});
    v("memory_limit", memory_limit,
      About{"MB over all ranks that a run may need: more is refused; 0: the memory of one machine"}.at_least(
          0));
    v("dump", dump,
      About{"folder, within that of the results, that receives every linear system with its right-hand side "
            "(HDF5); empty: none"});
    v("record_krylov", record_krylov,
      About{"write the residual of every Krylov iteration, block by block, to krylov.csv"});
    v("record_spectrum", record_spectrum,
      About{"write eigenvalue estimates of every preconditioned system to krylov.csv"});
  }
};

/// Newton's iteration and where it stops, all relative and free of units.
struct NewtonSettings {
  double force = 1e-6, volume = 1e-6, liquid = 1e-7, underway = 1, eta_max = 1e-3;
  int max_iterations = 25;
  template <class V>
  void describe(V&& v) {
    v("force", force,
      About{"largest force imbalance of a region relative to its internal forces"}.between(1e-13, 1e-1));
    v("volume", volume, About{"largest |V_e/V0_e - 1| of an element"}.between(1e-14, 1e-1));
    v("liquid", liquid,
      About{"largest violation of a liquid's law, relative to its volume"}.between(1e-15, 1e-1));
    v("underway", underway,
      About{"times that increments before the end of their step may miss these three"}.between(1, 1e6));
    v("eta_max", eta_max, About{"cap of the forcing term of Eisenstat and Walker"}.between(1e-14, 0.5));
    v("max_iterations", max_iterations, About{"iterations before the increment is cut"}.between(1, 1000));
  }
};

/// How increments are cut and grown.
struct SteppingSettings {
  double smallest = 1e-3, growth = 1.5, increments = 1;
  int easy = 6;
  template <class V>
  void describe(V&& v) {
    v("smallest", smallest,
      About{"smallest increment, as a part of the step, before the run gives up"}.between(1e-9, 1));
    v("growth", growth, About{"factor after an easy increment"}.between(1, 10));
    v("easy", easy, About{"Newton iterations that count as easy"}.between(1, 100));
    v("increments", increments,
      About{"times as many increments as the steps say, rounded up"}.between(1e-5, 1000));
  }
};

struct SolverSettings {
  std::string accuracy = "tight";
  LinearSettings linear;
  NewtonSettings newton;
  SteppingSettings stepping;
  template <class V>
  void describe(V&& v) {
    v("accuracy", accuracy, About{accuracy_help()}.one_of({"fast", "balanced", "tight"}));
    v("linear", linear, About{"the linear solver"});
    v("newton", newton, About{"Newton's iteration"});
    v("stepping", stepping, About{"increments"});
  }
  static constexpr const char* preset_key = "accuracy";
  /// Gives what `accuracy` steers its values; the reader calls it before single settings override them.
  void take_preset();
  /// What each accuracy promises.
  static std::string accuracy_help();
};

}  // namespace bulbus
