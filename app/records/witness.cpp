#include "app/records/witness.hpp"

#include <algorithm>
#include <cmath>

#include "core/problem/formula.hpp"
#include "core/problem/region_material.hpp"
#include "core/problem/strained_cells.hpp"

namespace bulbus::inline app {

void Witness::step_begins(int step, const State& start) {
  const StepSpec& spec = problem_.model().steps[step];
  step_ = step, done_ = 0, liquid_ = -1, end_pressure_ = 0;
  for (const auto& [name, text] : spec.pressures) {
    const double end = std::abs(Formula(text, name)({0, 0, 0}, 1, step + 1));
    end_pressure_ = std::max(end_pressure_, end);
    for (std::size_t i = 0; i < problem_.liquids().size(); ++i)
      if (problem_.liquids()[i].name() == name && end > std::abs(start.P[i])) liquid_ = static_cast<int>(i);
  }
  pressure_grows_ = liquid_ >= 0;
  for (const LoadSpec& load : spec.loads)
    if (load.pressure) {
      pressure_grows_ = true;
      end_pressure_ =
          std::max(end_pressure_, std::abs(Formula(*load.pressure, "pressure")({0, 0, 0}, 1, step + 1)));
    }
  start_ = first_ = before_ = last_ = response(0, start);
}

Witness::Response Witness::response(double progress, const State& state) const {
  Response r{.progress = progress};
  if (!pressure_grows_) return r;
  if (liquid_ >= 0) r.volume = problem_.liquids()[liquid_].volume(state.x);
  const LocalMesh& mesh = problem_.mesh();
  for (int i = 0; i < 3 * mesh.owned; ++i) r.displacement += std::pow(state.x[i] - mesh.X[i], 2);
  r.displacement = std::sqrt(mesh.comm.sum(r.displacement) / static_cast<double>(mesh.all_nodes));
  return r;
}

void Witness::increment_done(const Increment& increment, const State& state) {
  before_ = last_;
  last_ = response(increment.progress, state);
  if (++done_ == 1) first_ = last_;
  pivots_ = increment.newton.negative_pivots;
}

void Witness::increment_cut(const NewtonReport& report) {
  outcome_ = report.outcome;
  reason_ = report.reason;
}

// At a limit point the response grows as the square root of the distance to it: its slope without bound.
double Witness::softening() const {
  if (done_ < 2 || !(last_.progress > before_.progress)) return 1;
  const auto slope = [&](double Response::*figure, const Response& a, const Response& b) {
    return (b.*figure - a.*figure) / (b.progress - a.progress);
  };
  const auto figure = liquid_ >= 0 ? &Response::volume : &Response::displacement;
  const double begin = slope(figure, start_, first_), end = slope(figure, before_, last_);
  return begin > 0 ? end / begin : 1;
}

FailureFacts Witness::facts(const State& last, bool touching) const {
  const LocalMesh& mesh = problem_.mesh();
  FailureFacts f{.outcome = outcome_,
                 .reason = reason_,
                 .step = problem_.model().steps[step_].name,
                 .progress = last_.progress,
                 .pressure_grows = pressure_grows_};
  if (liquid_ >= 0) f.liquid = problem_.liquids()[liquid_].name(), f.pressure = last.P[liquid_];
  f.softening = softening();
  f.surplus_pivots = pivots_ < 0 ? 0 : pivots_ - stable_pivots_;
  double modulus = 0, size = 0, way = 0;
  for (const auto& [name, spec] : problem_.model().regions)
    if (!spec.rigid) modulus = std::max(modulus, initial_shear_modulus(material_of(spec)));
  f.largest_pressure = modulus > 0 ? end_pressure_ / modulus : 0;
  for (std::size_t i = 0; i < last.x.size(); ++i)
    size = std::max(size, std::abs(mesh.X[i])), way = std::max(way, std::abs(last.x[i] - mesh.X[i]));
  f.displacement = mesh.comm.max(way) / mesh.comm.max(size);
  const StrainedCells cells = strained_cells(problem_, last.x);
  f.unstable_region = cells.unstable_region, f.unstable_hexes = cells.unstable;
  f.alternating = alternating_pressures(problem_, last);
  f.squeezed_region = cells.squeezed_region, f.squeezed_hex = cells.squeezed,
  f.least_jacobian = cells.least_jacobian;
  f.contacts = !problem_.model().contacts.empty();
  f.touching = touching;
  return f;
}

}  // namespace bulbus::inline app
