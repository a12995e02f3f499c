#include "precond/preconditioner_cache.hpp"

#include <limits>

namespace bulbus::inline precond {
namespace {

constexpr double without_bounds = std::numeric_limits<double>::infinity();

}  // namespace

PreconditionerCache::PreconditionerCache(const LinearSettings& settings, Profiler& profiler)
    : settings_(settings), profiler_(profiler), factory_(settings) {}

// Leaves a displacement preconditioner that fits the present tangent. Returns what is of an earlier one.
Reuse PreconditionerCache::refreshed(const SharedSystem& system) {
  const ReuseLimits limits{settings_.reuse, settings_.coarse_change,
                           system->problem().mesh().refinements > 0};
  TangentChange change;
  Reuse reuse = reusable(limits, history_, change);
  if (reuse.displacement) {
    change.largest_eigenvalue = displacement_ ? displacement_->refresh(system) : without_bounds;
    reuse = reusable(limits, history_, change);
    if (reuse.displacement) return reuse;
  }
  displacement_.reset();  // two would need the memory of both
  if (!reuse.corrections) corrections_.reset(), columns_.reset();
  KeepFactors keep;
  if (reuse.coarse_factors)
    keep = [&](double coarse_rows) {
      change.coarse_rows = coarse_rows;
      return reusable(limits, history_, change).coarse_factors;
    };
  displacement_ = factory_.make(system, keep);
  return displacement_->keeps_factors() ? reuse : Reuse{};
}

bool PreconditionerCache::can_improve() const {
  return history_.solves > 0 || (displacement_ && displacement_->could_be_factorised());
}

void PreconditionerCache::improve() {
  if (history_.solves == 0) factory_.factorise_coarse();
  forget();
}

std::unique_ptr<CoupledPreconditioner> PreconditionerCache::make(SharedSystem system) {
  reused_ = refreshed(system);
  if (!reused_.anything()) forget();
  if (!reused_.corrections) corrections_.reset(), columns_.reset();
  profiler_.memory.set("displacement preconditioner", displacement_->bytes());
  if (!corrections_) corrections_ = std::make_shared<SchurCorrections>();
  corrections_->refresh(system);
  if (!columns_) columns_ = std::make_shared<LiquidColumns>();
  return std::make_unique<BlockTriangular>(std::move(system), displacement_, settings_.pressures,
                                           corrections_, columns_);
}

void PreconditionerCache::release() {
  if (displacement_) displacement_->release();
  if (corrections_) corrections_->release();
}

}  // namespace bulbus::inline precond
