#include "precond/pressure_schur.hpp"

#include <algorithm>
#include <functional>

#include "core/base/memory.hpp"

namespace bulbus {

PressureSchur::PressureSchur(const CoupledSystem& system, const LineJacobi* lines, const PressureSettings& settings)
    : system_(system), lines_(lines), settings_(settings), diagonal_(system.inverse_pressure_schur()) {}

void PressureSchur::strengthen() {
  if (!holds_back()) return;
  const int refinements = system_.problem().mesh().refinements;
  if (refinements > 0) softened_ = std::make_unique<const LineJacobi>(system_, lines_->lines(), Matrices::softened);
  const LineJacobi& lines = softened_ ? *softened_ : *lines_;
  if (refinements != 1) K_ = std::make_unique<const LinePressureStiffness>(system_, lines);
  if (refinements == 0) weak_.push_back(rough_part(system_, lines, *K_, settings_.degree));
  if (refinements > 1) weak_.push_back(fine_patterns_part(system_, *K_, settings_.degree));
  if (refinements > 0) weak_.push_back(coarse_patterns_part(system_, lines, refinements > 1 ? 0 : settings_.degree));
  if (!K_) softened_.reset();
}

void PressureSchur::apply(std::span<const double> r, std::span<double> z) const {
  std::ranges::transform(diagonal_, r, z.begin(), std::multiplies{});
  for (const auto& part : weak_) part->add(r, settings_.weight, z);
}

std::size_t PressureSchur::bytes() const {
  std::size_t total = bytes_of(diagonal_) + (softened_ ? softened_->bytes() : 0) + (K_ ? K_->bytes() : 0);
  for (const auto& part : weak_) total += part->bytes();
  return total;
}

}  // namespace bulbus
