#pragma once
#include <string>

#include "core/base/parameters.hpp"
#include "core/solve/linear_settings.hpp"

namespace bulbus::inline solve {

/// Newton's iteration and where it stops, all relative and free of units.
struct NewtonSettings {
  double force = 5e-7, volume = 1e-6, liquid = 1e-7, intermediate = 1, eta_max = 1e-3;
  int max_iterations = 25;
  template <class V>
  void describe(V&& v) {
    v("force", force,
      About{"largest force imbalance of a region relative to its internal forces"}.between(1e-13, 1e-1));
    v("volume", volume, About{"largest |V_e/V0_e - 1| of an element"}.between(1e-14, 1e-1));
    v("liquid", liquid,
      About{"largest violation of a liquid's law, relative to its volume"}.between(1e-15, 1e-1));
    v("intermediate", intermediate,
      About{"factor by which increments before the end of their step may miss these three"}
          .between(1, 1e6)
          .formerly("underway")
          .expert());
    v("eta_max", eta_max,
      About{"cap of the forcing term of Eisenstat and Walker"}
          .between(1e-14, 0.5)
          .expert()
          .only_with("solver.linear.method", Method::iterative));
    v("max_iterations", max_iterations, About{"iterations before the increment is cut"}.between(1, 1000));
  }
};

/// How increments are cut and grown.
struct SteppingSettings {
  double minimum = 1e-3, growth = 1.5, increments = 1;
  int target_iterations = 6;
  bool extrapolate = true;
  template <class V>
  void describe(V&& v) {
    v("minimum", minimum,
      About{
          "minimum increment, as a part of the step, before the run gives up; a sixteenth of the step's own "
          "increments if that is less"}
          .between(1e-9, 1)
          .formerly("smallest"));
    v("target_iterations", target_iterations,
      About{"Newton iterations up to which the next increment grows at once"}.between(1, 100).formerly(
          "easy"));
    v("growth", growth, About{"growth factor of an increment"}.between(1, 10));
    v("increments", increments,
      About{"times as many increments as the steps say, rounded up"}.between(1e-5, 1000));
    v("extrapolate", extrapolate,
      About{"begin increments after the first of a step where the last two converged states point to"}
          .expert());
  }
};

struct SolverSettings {
  Accuracy accuracy = Accuracy::tight;
  LinearSettings linear;
  NewtonSettings newton;
  SteppingSettings stepping;
  template <class V>
  void describe(V&& v) {
    v("accuracy", accuracy, About{accuracy_help()});
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

}  // namespace bulbus::inline solve
