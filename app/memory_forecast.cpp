#include "app/memory_forecast.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include "app/size_limits.hpp"
#include "core/base/memory.hpp"

namespace bulbus {
namespace {

double resident(const Comm& comm) {
  malloc_trim(0);  // what the preparation gave back
  return comm.sum(static_cast<double>(resident_bytes()));
}

double contact_points(const Operation& operation) {
  double points = 0;
  for (const auto& c : operation.contacts()) points += static_cast<double>(c.term->points().size());
  return points;
}

RunSize size_of(const Prepared& prepared) {
  const Problem& problem = *prepared.problem;
  RunSize size{.liquids = static_cast<double>(problem.liquids().size()),
               .refinements = problem.mesh().refinements,
               .ranks = problem.comm().size()};
  size.contact_points = problem.comm().sum(contact_points(*prepared.operation));
  for (const Problem* p = &problem; p; p = p->coarser()) {
    std::array<double, 2> sums{static_cast<double>(p->mesh().nodes()),
                               static_cast<double>(p->mesh().hexes.size())};
    p->comm().sum(sums);
    size.levels.push_back({sums[0], sums[1]});
  }
  return size;
}

}  // namespace

std::vector<MemoryPart> forecast_memory(const Prepared& prepared, const Scene& scene) {
  const Problem& problem = *prepared.problem;
  std::vector<MemoryPart> parts{{"program, mesh and problem", resident(problem.comm())}};
  for (MemoryPart& part : parts_of_solution(size_of(prepared), scene)) parts.push_back(std::move(part));
  return parts;
}

void refuse_what_cannot_fit(const std::vector<MemoryPart>& parts, const LinearSettings& l) {
  if (l.method != "direct") refuse_more_than_there_is(parts, l);
}

}  // namespace bulbus
