#pragma once
#include <functional>

#include "app/prepare.hpp"
#include "app/records/recorder.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::test {

/// Thrown where a run is left.
struct Left {};

/// Passes everything on, and tells when an increment rests.
class Leaving final : public MarchObserver {
 public:
  Leaving(MarchObserver& inner, const std::function<void(int)>& rested) : inner_(inner), rested_(rested) {}
  void step_begins(int step, const StepSpec& spec, const State& start) override {
    inner_.step_begins(step, spec, start);
  }
  void step_begun(int step, const State& start) override { inner_.step_begun(step, start); }
  void increment_done(const Increment& increment, const State& state) override {
    inner_.increment_done(increment, state);
  }
  void rests(const MarchProgress& place, State& state, bool last) override {
    inner_.rests(place, state, last);
    rested_(place.report.increments);
  }

 private:
  MarchObserver& inner_;
  const std::function<void(int)>& rested_;
};

/// Solves a scene directly into a folder as a run does, which is left where `rested` (of each converged
/// increment) throws Left, as if killed. Collective.
inline void run_and_leave(const Scene& scene, const std::string& folder, const Comm& comm,
                          const std::function<void(int)>& rested) {
  Profiler profiler;
  const Prepared prepared = prepare(scene, comm);
  ResultsFolder results(folder, record_names(scene), comm);
  results.begin();
  results.claim({log_file});
  const Log log(folder + "/run.log", comm, Log::Screen::silent);
  Recorder recorder(prepared, scene, results, log, profiler);
  const auto solver = make_direct_solver(scene.solver.linear, profiler);
  SolverSettings settings = scene.solver;
  settings.linear.gamma = 0;
  State state = prepared.problem->initial_state();
  Leaving leaving(recorder, rested);
  try {
    march(*prepared.problem, *solver, state, settings, profiler, leaving);
  } catch (const Left&) {
  }
}

/// Liquid, bodies, contacts (one augmented), a string, probes that count from the end of a step, and a set
/// that is held where it has come to: all that a checkpoint has to bring back, 10 increments in about a
/// second.
inline const std::string full_of_memory = R"yaml(title: everything that is remembered
mesh: {shell: {inner: 11, outer: 12, n: 4, layers: 2, part: octant}}
regions:
  shell: {c10: 80 kPa}
liquids:
  inside: {surface: inner}
symmetry: [x, y, z]
rigid_bodies:
  tire: {tire: {width: 4, crown: 2, radius: 12.2, from: 0, to: 30}}
  plate: {plane: {point: [0, 0, 11.95], normal: [0, 0, -1]}}
contacts:
  - {name: under, slave: outer, master: tire, tolerance: 0.002, divisions: 2}
  - {name: pole, slave: outer, master: plate, start: resolve}
sutures:
  string: {body: tire, surface: outer, points: [[0, 11.3, 4]]}
steps:
  - name: inflate
    increments: 3
    pressures: {inside: 15 mmHg}
    loads: [{surface: outer, pressure: 0.1 kPa}]
  - name: press
    increments: 3
    enclose: [inside]
    move:
      - {body: tire, from: touch, close: 0.3}
      - {body: plate, translate: [0, 0, -.4]}
  - name: sew
    increments: 2
    displace: [{set: zmin, radial: 0, from: start}]
    sew: {string: 0.01}
    add: {inside: -20 uL}
    move: [{body: tire, rotate: {angle: 2 deg, axis: [0, 0, 1]}}]
  - name: drain
    increments: 2
    loads: [{surface: outer, pressure: 0.3 kPa}]
    add: {inside: -10 uL}
probes:
  - {name: pressure, kind: pressure, liquid: inside, unit: mmHg}
  - {name: volume, kind: volume, liquid: inside, unit: mL}
  - {name: sink, kind: displacement, set: outer, statistic: max, since: press}
  - {name: area, kind: contact_area, contact: under}
  - {name: under, kind: contact_pressure, contact: under}
  - {name: pole, kind: contact_pressure, contact: pole}
  - {name: gap, kind: gap, contact: under, statistic: min}
  - {name: suture, kind: suture_force, suture: string}
  - {name: bite, kind: suture_mises, suture: string}
  - {name: mises, kind: mises, unit: kPa}
solver:
  linear: {method: direct}
  newton: {force: 1e-11, volume: 1e-11, liquid: 1e-12}
output: {checkpoint: 1, every: 2}
)yaml";
constexpr int increments_of_memory = 10;

/// What round-off of one of its probes is small against: a gap is a difference of places 12 mm away, a
/// contact pressure some 5 MPa/mm times a gap. (The same run on the same ranks differs that much from
/// itself.)
inline double size_of(const std::string& probe, double value) {
  const bool of_a_gap = probe == "gap" || probe == "under" || probe == "pole";
  return std::max(std::abs(value), of_a_gap ? 1. : .01);
}

}  // namespace bulbus::test
