#include <algorithm>
#include <cmath>

#include "app/trade/trade_results.hpp"

namespace bulbus::inline app {
namespace {

constexpr double least_length = .5, least_pressure = 5 * 133.322e-6;  // mm, MPa
constexpr double least_power = .25;                                   // D, the step of trial lenses

template <class Error>
std::optional<TradeError> largest(const TradeResults& results, int run, Error error) {
  std::optional<TradeError> most;
  if (!results.converged(run)) return most;
  for (int figure = 0; figure < static_cast<int>(results.figures.size()); ++figure)
    if (const auto e = error(figure); e && (!most || *e > most->value)) most = TradeError{*e, figure};
  return most;
}

bool is_known(const Trade& trade, const TradeResults& results, int mesh) {
  return trade.meshes[mesh].reference >= 0 && results.converged(trade.meshes[mesh].reference);
}

template <class Error>
std::vector<ParetoCandidate> candidates(const TradeResults& results, Error error) {
  std::vector<ParetoCandidate> all;
  for (int run = 1; run < static_cast<int>(results.runs.size()); ++run)
    if (const std::optional<TradeError> e = error(run))
      all.push_back({run, results.rows[run]->seconds, e->value});
  std::ranges::stable_sort(all, {}, &ParetoCandidate::seconds);
  return all;
}

}  // namespace

double relative_error(double value, double right, double least) {
  const double size = std::max(std::abs(right), least);
  return value == right ? 0 : std::abs(value - right) / (size > 0 ? size : std::abs(value));
}

double least_of(const ProbeSpec& probe) {
  const bool pressure = probe.kind == "pressure" || probe.kind == "mean_contact_pressure";
  const auto in_its_unit = [&](double v) {
    const Quantity quantity = pressure ? Quantity::stress : Quantity::length;
    return std::abs(probe.scale) * v / (probe.unit.empty() ? 1 : parse_quantity("1 " + probe.unit, quantity));
  };
  for (const char* share : {"closed_fraction", "sealed_fraction", "contact_fraction"})
    if (probe.kind == share) return std::abs(probe.scale);
  for (const char* power : {"refraction", "corneal_power", "corneal_astigmatism"})
    if (probe.kind == power) return std::abs(probe.scale) * least_power;
  if (pressure) return in_its_unit(least_pressure);
  for (const char* length : {"displacement", "position", "distance", "buckle_height", "gap", "penetration"})
    if (probe.kind == length) return in_its_unit(least_length);
  return 0;
}

void extrapolate(const Trade& trade, TradeResults& results) {
  std::vector<int> meshes;
  for (int m = 0; m < static_cast<int>(trade.meshes.size()); ++m)
    if (trade.meshes[m].h && is_known(trade, results, m)) meshes.push_back(m);
  std::ranges::sort(meshes, std::greater{}, [&](int m) { return *trade.meshes[m].h; });
  results.extrapolated.assign(results.figures.size(), {});
  for (std::size_t f = 0; f < results.figures.size(); ++f) {
    std::vector<double> h, v;
    for (int m : meshes)
      if (const auto value = results.value(trade.meshes[m].reference, static_cast<int>(f))) {
        h.push_back(*trade.meshes[m].h);
        v.push_back(*value);
      }
    if (h.size() > 1) results.extrapolated[f] = extrapolate(h, v);
  }
}

std::optional<double> mesh_error(const Trade& trade, const TradeResults& results, int run, int figure) {
  const int right = trade.meshes[trade.runs[run].mesh].reference;
  const auto value = results.value(run, figure), known = results.value(right, figure);
  if (!value || !known || !results.converged(right)) return {};
  return relative_error(*value, *known, results.least[figure]);
}

std::optional<double> whole_error(const TradeResults& results, int run, int figure) {
  const auto value = results.value(run, figure);
  const auto& right = results.extrapolated[figure];
  if (!value || !right) return {};
  return relative_error(*value, right->value, results.least[figure]);
}

std::optional<TradeError> mesh_error(const Trade& trade, const TradeResults& results, int run) {
  return largest(results, run, [&](int figure) { return mesh_error(trade, results, run, figure); });
}

std::optional<TradeError> whole_error(const TradeResults& results, int run) {
  return largest(results, run, [&](int figure) { return whole_error(results, run, figure); });
}

const ParetoCandidate* better_than(const ParetoCandidate& one, const std::vector<ParetoCandidate>& all) {
  const ParetoCandidate* best = nullptr;
  for (const ParetoCandidate& other : all)
    if (other.error <= one.error && other.seconds < (1 - noise) * one.seconds &&
        (!best || other.seconds < best->seconds))
      best = &other;
  return best;
}

std::vector<ParetoCandidate> candidates_on_mesh(const Trade& trade, const TradeResults& results) {
  return candidates(results, [&](int run) {
    return trade.runs[run].mesh == 0 ? mesh_error(trade, results, run) : std::nullopt;
  });
}

std::vector<ParetoCandidate> candidates_on_all(const TradeResults& results) {
  return candidates(results, [&](int run) { return whole_error(results, run); });
}

}  // namespace bulbus::inline app
