#include "core/solve/unloaded_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/interrupt.hpp"
#include "core/mesh/distributed/bounds.hpp"
#include "core/solve/anderson.hpp"

namespace bulbus::inline solve {
namespace {

// Parts of the loads, and of an element's volume from one reference to the next: formulation, section 4.3.
constexpr double least_part = 1.0 / 16, least_jacobian = 0.1;
// Of the first distance: enough before all of the loads act. Whatever is left is made good by the iterations
// of the next part; a larger one begins farther away, a smaller one takes iterations that are thrown away.
constexpr double intermediate = 1e-2;
// Of the linear solves. A lens in its zonules hardly counts in the residual: looser solves leave it where it
// is, so that distances come out too small one time and too large the next.
constexpr double eta = 1e-5;
// Iterations in which the least distance does not fall: more than the eight that the acceleration combines by
// default, so that all of those came after the best one.
constexpr int most_without_progress = 12;
// Of a step of the reference: that of Newton's (docs/decisions/033).
constexpr double least_step_length = 1.0 / 8;

// What an iteration begins with, besides the drawn positions, where the nodes are in all of them.
struct Iterate {
  std::vector<double> X, lambda;
  std::vector<Pose> bodies;  // rigid regions, from the reference to the drawn positions
};

// One Newton step with the tangent at the drawn positions, whatever the residual is.
NewtonSettings single_step() {
  NewtonSettings s;
  s.force = s.volume = s.liquid = 1e-300;
  s.eta_max = eta;
  s.max_iterations = 1;
  return s;
}

// Of the longest side of the box around the mesh: the most that a distance may be, so that small meshes are
// found as well as large ones.
constexpr double part_of_size = 1e-7;

bool usable(const NewtonReport& r) {
  return r.outcome == Outcome::converged || r.outcome == Outcome::too_many_iterations;
}

class Search {
 public:
  Search(std::vector<MeshLevel>& levels, const Model& model, const ReferenceSpec& spec,
         const UnloadedSolver& solver, const UnloadedObserver& observer)
      : levels_(levels),
        model_(model),
        spec_(spec),
        solver_(solver),
        observer_(observer),
        mesh_(*levels.back().mesh),
        drawn_(mesh_.X),
        tolerance_(std::min(spec.tolerance,
                            part_of_size * std::ranges::max(bounds_of(mesh_.comm, mesh_.X).sides()))) {}

  UnloadedReport run() {
    const double start = Clock::now();
    Iterate good{drawn_, std::vector<double>(mesh_.hexes.size()), {}};
    double done = 0;
    for (double part = 1; done < 1 && part >= least_part && report_.signal == 0;) {
      const double load = std::min(1.0, done + part);
      Iterate trial = good;
      if (reach(load, trial))
        good = std::move(trial), done = load;
      else
        part /= 2, ++report_.divisions;
    }
    report_.found = done == 1;
    if (!report_.found) good.X = drawn_;
    report_.way = largest_distance(mesh_, good.X, drawn_);
    if (report_.found)
      report_.loaded = std::make_shared<State>(State{drawn_, good.lambda, pressures_, good.bodies});
    move_reference(levels_, std::move(good.X));
    report_.seconds = Clock::now() - start;
    return report_;
  }

 private:
  // Iterates under a part of the loads. False where it fails.
  bool reach(double load, Iterate& iterate) {
    AndersonAcceleration anderson(spec_.depth, static_cast<std::size_t>(3 * mesh_.owned), mesh_.comm);
    double enough = tolerance_, least = 0, before = 0;
    int since = 0;  // the least distance
    for (int k = 0; k < spec_.max_iterations; ++k, ++since) {
      move_reference(levels_, iterate.X);
      Problem problem(std::move(levels_), model_);
      const auto distance = improve(problem, load, enough, anderson, iterate);
      levels_ = std::move(problem).take_levels();
      if (!distance) return false;
      tell(load, *distance, before);
      if (k == 0 && load < 1) enough = intermediate * *distance;
      if (*distance <= enough) return true;
      if (k == 0 || *distance < least) least = *distance, since = 0;
      if (since == most_without_progress)
        return fail(fmt::format("the distances do not fall below {:.2g} mm", least));
      before = *distance;
    }
    return fail(fmt::format("{} iterations leave a distance of {:.2g} mm", spec_.max_iterations, before));
  }

  // Takes the step from the drawn positions and moves the reference back by it. Returns the distance, mm.
  std::optional<double> improve(Problem& problem, double load, double enough, AndersonAcceleration& anderson,
                                Iterate& iterate) {
    State state = problem.initial_state();
    problem.begin_step(0, state);
    place(problem, iterate, state);
    const auto solver = solver_.make();
    newton_ = newton(problem, solver_.linear, *solver, state, load, single_step(), solver_.profiler);
    if (newton_.outcome == Outcome::interrupted) report_.signal = interrupt(problem.comm());
    if (!usable(newton_)) return fail(newton_.reason), std::nullopt;
    const double length = newton_.iterations.empty() ? 1 : newton_.iterations[0].step;
    const double distance = largest_distance(mesh_, state.x, drawn_) / length;
    std::vector<double> X(iterate.X);
    for (std::size_t i = 0; i < X.size(); ++i) X[i] -= state.x[i] - drawn_[i];
    iterate.lambda = std::move(state.lambda);
    pressures_ = state.P;
    keep_shapes(problem, state, X, iterate);
    if (distance > enough) X = accelerated(problem, iterate.X, std::move(X), anderson);
    if (!move_without_inversion(problem, X, iterate)) return std::nullopt;
    return distance;
  }

  void place(const Problem& problem, const Iterate& iterate, State& state) {
    if (centers_.empty())
      for (const RigidBody& body : problem.dofs().bodies()) centers_.push_back(body.center());
    state.x = drawn_;
    state.lambda = iterate.lambda;
    if (!iterate.bodies.empty()) state.bodies = iterate.bodies;
  }

  // The reference of a rigid region is its drawn shape, moved back as a whole, and so is its centre.
  void keep_shapes(const Problem& problem, const State& state, std::span<double> X, Iterate& iterate) {
    iterate.bodies.clear();
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      const RigidBody& body = problem.dofs().bodies()[b];
      const Pose& pose = state.bodies[b];
      const Vec3<double> arm = minus(centers_[b], body.center());
      Pose back, of_next{pose.rotation, arm};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          back.rotation(i, j) = pose.rotation(j, i);
          back.shift[i] -= pose.rotation(j, i) * pose.shift[j];
          of_next.shift[i] -= pose.rotation(j, i) * (arm[j] - pose.shift[j]);
        }
      body.place(back, drawn_, X);
      iterate.bodies.push_back(of_next);
    }
  }

  std::vector<double> accelerated(const Problem& problem, std::span<const double> from,
                                  std::vector<double> to, AndersonAcceleration& anderson) const {
    std::vector<double> f(to);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] -= from[i];
    auto X = anderson.next(from, f);
    mesh_.halo.update_ghosts(X);
    for (const RigidBody& body : problem.dofs().bodies())
      for (int n : body.nodes()) std::copy_n(&to[3 * n], 3, &X[3 * n]);
    return X;
  }

  // Are cavities still open? A sphere turned through its middle has elements of positive volume.
  static bool cavities_open(const Problem& problem, std::span<const double> before,
                            std::span<const double> X) {
    return std::ranges::all_of(
        problem.liquids(), [&](const Liquid& l) { return l.volume(X) > least_jacobian * l.volume(before); });
  }

  // As far as no element of the reference inverts and no cavity closes.
  bool move_without_inversion(const Problem& problem, std::span<const double> to, Iterate& iterate) {
    std::vector<double> X(to.size());
    for (double part = 1; part >= least_step_length; part /= 2) {
      for (std::size_t i = 0; i < X.size(); ++i) X[i] = iterate.X[i] + part * (to[i] - iterate.X[i]);
      if (mesh_.comm.min(problem.solid().least_jacobian(X)) > least_jacobian &&
          cavities_open(problem, iterate.X, X)) {
        iterate.X = std::move(X);
        return true;
      }
    }
    return fail("an element or a cavity of the unloaded mesh would turn inside out");
  }

  bool fail(std::string reason) {
    report_.reason = std::move(reason);
    return false;
  }

  void tell(double load, double distance, double before) {
    report_.distance = distance;
    report_.krylov_iterations += newton_.krylov_iterations;
    UnloadedIteration told{.number = ++report_.iterations,
                           .load = load,
                           .distance = distance,
                           .ratio = before > 0 ? distance / before : 0,
                           .krylov_iterations = newton_.krylov_iterations,
                           .negative_pivots = newton_.negative_pivots};
    if (!newton_.iterations.empty()) {
      told.tolerance = newton_.iterations[0].tolerance;
      report_.curvature = newton_.iterations[0].linear.curvature;
      report_.negative_pivots = newton_.negative_pivots;
    }
    observer_(told);
  }

  std::vector<MeshLevel>& levels_;
  const Model& model_;
  const ReferenceSpec& spec_;
  const UnloadedSolver& solver_;
  const UnloadedObserver& observer_;
  const LocalMesh& mesh_;  // the finest
  const std::vector<double> drawn_;
  double tolerance_;                   // mm
  std::vector<Vec3<double>> centers_;  // of rigid regions, as drawn
  std::vector<double> pressures_;      // of the liquids
  NewtonReport newton_;                // of the last iteration
  UnloadedReport report_;
};

}  // namespace

double largest_distance(const LocalMesh& mesh, std::span<const double> a, std::span<const double> b) {
  double most = 0;
  for (int n = 0; n < mesh.owned; ++n) most = std::max(most, norm(minus(at(a, n), at(b, n))));
  return mesh.comm.max(most);
}

UnloadedReport find_unloaded(std::vector<MeshLevel>& levels, const Model& model, const ReferenceSpec& spec,
                             const UnloadedSolver& solver, const UnloadedObserver& observer) {
  return Search(levels, model, spec, solver, observer).run();
}

}  // namespace bulbus::inline solve
