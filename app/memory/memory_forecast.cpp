#include "app/memory/memory_forecast.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include "app/scene/size_limits.hpp"
#include "core/base/memory.hpp"

namespace bulbus::inline app {
namespace {

double resident(const Comm& comm) {
  malloc_trim(0);  // what the preparation gave back
  return comm.sum(static_cast<double>(resident_bytes()));
}

double contact_points(const Interactions& interactions) {
  double points = 0;
  for (const auto& c : interactions.contacts())
    points += static_cast<double>(c.term->points().size() + (c.exchanged ? c.exchanged->points().size() : 0) +
                                  (c.middles ? c.middles->points() : 0));
  return points;
}

RunSize size_of(const Prepared& prepared) {
  const Problem& problem = *prepared.problem;
  RunSize size{.liquids = static_cast<double>(problem.liquids().size()),
               .refinements = problem.mesh().refinements,
               .ranks = problem.comm().size(),
               .symmetric = problem.symmetric()};
  size.contact_points = problem.comm().sum(contact_points(*prepared.interactions));
  for (const Problem* p = &problem; p; p = p->coarser()) {
    std::array<double, 2> sums{static_cast<double>(p->mesh().nodes()),
                               static_cast<double>(p->mesh().hexes.size())};
    p->comm().sum(sums);
    size.levels.push_back({sums[0], sums[1]});
  }
  return size;
}

}  // namespace

MemoryForecast forecast_memory(const Prepared& prepared, const Scene& scene) {
  const RunSize size = size_of(prepared);
  MemoryForecast forecast{{{"program, mesh and problem", resident(prepared.problem->comm())}},
                          bytes_of_fallback(size, scene)};
  for (MemoryPart& part : parts_of_solution(size, scene)) forecast.parts.push_back(std::move(part));
  return forecast;
}

std::vector<std::string> lines_of(const MemoryForecast& forecast, const LinearSettings& l) {
  std::vector<std::string> lines{
      fmt::format("memory to expect with the {} solver, over all ranks (MB):", word_of(l.method))};
  const auto add = [&](const std::string& name, double bytes) {
    lines.push_back(fmt::format("  {:<28} {:>10.1f}", name, 1e-6 * bytes));
  };
  for (const auto& [name, bytes] : forecast.parts) add(name, bytes);
  add("together", forecast.together());
  if (forecast.fallback == 0) return lines;
  const double all = forecast.together() + forecast.fallback;
  add("with MUMPS as fallback", all);
  if (all > memory_of(l))
    lines.push_back(
        fmt::format("  That is more than the {:.0f} MB {}: such a system cuts the increment instead.",
                    1e-6 * memory_of(l), whose_memory(l)));
  return lines;
}

void refuse_what_cannot_fit(const MemoryForecast& forecast, const LinearSettings& l) {
  if (l.method != Method::direct) refuse_more_than_there_is(forecast.parts, l);
}

}  // namespace bulbus::inline app
