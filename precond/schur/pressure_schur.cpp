#include "precond/schur/pressure_schur.hpp"

#include <algorithm>
#include <functional>

#include "core/base/memory.hpp"
#include "core/solve/fgmres.hpp"

namespace bulbus::inline precond {

PressureSchur::PressureSchur(SharedSystem system, std::shared_ptr<const LineJacobi> lines,
                             const PressureSettings& settings, std::shared_ptr<SchurCorrections> corrections)
    : system_(std::move(system)),
      lines_(std::move(lines)),
      settings_(settings),
      diagonal_(system_->inverse_pressure_schur()),
      corrections_(std::move(corrections)) {}

void PressureSchur::enable_deferred_component(double tolerance) {
  if (!has_deferred_component()) return;
  corrected_ = true;
  auto& [reduced, K, parts, for_many_digits] = *corrections_;
  const int refinements = system_->problem().mesh().refinements;
  const bool many_digits = refinements == 0 && tolerance < least_of_plain_method;
  if (!parts.empty() && (for_many_digits || !many_digits)) return;
  parts.clear();
  for_many_digits = many_digits;
  if (refinements > 0)
    reduced = std::make_shared<const LineJacobi>(*system_, lines_->lines(), Matrices::reduced_augmentation);
  const auto lines = reduced ? reduced : lines_;
  if (refinements != 1) K = std::make_shared<LinePressureStiffness>(system_, lines);
  if (refinements == 0)
    parts.push_back(oscillation_correction(*system_, *lines, K, settings_.degree, many_digits));
  if (refinements > 1) parts.push_back(fine_checkerboard_correction(*system_, K, settings_.degree));
  if (refinements > 0)
    parts.push_back(
        coarse_checkerboard_correction(*system_, *lines, refinements > 1 ? std::nullopt : settings_.degree));
  if (!K) reduced.reset();
}

void PressureSchur::apply(std::span<const double> r, std::span<double> z) const {
  std::ranges::transform(diagonal_, r, z.begin(), std::multiplies{});
  if (!corrected_) return;
  for (const auto& part : corrections_->parts) part->add(r, settings_.weight, z);
}

std::size_t PressureSchur::bytes() const { return bytes_of(diagonal_) + corrections_->bytes(); }

void SchurCorrections::refresh(const SharedSystem& system) {
  if (K) K->refresh(system);
}

void SchurCorrections::release() {
  if (K) K->release();
}

std::size_t SchurCorrections::bytes() const {
  std::size_t total = (reduced ? reduced->bytes() : 0) + (K ? K->bytes() : 0);
  for (const auto& part : parts) total += part->bytes();
  return total;
}

}  // namespace bulbus::inline precond
