#include "precond/schur/pressure_schur.hpp"

#include <algorithm>
#include <functional>

#include "core/base/memory.hpp"

namespace bulbus {

PressureSchur::PressureSchur(const CoupledSystem& system, const LineJacobi* lines,
                             const PressureSettings& settings, Weak& weak)
    : system_(system),
      lines_(lines),
      settings_(settings),
      diagonal_(system.inverse_pressure_schur()),
      weak_(weak) {}

void PressureSchur::enable_deferred_component() {
  if (!has_deferred_component()) return;
  strong_ = true;
  if (!weak_.parts.empty()) return;
  const int refinements = system_.problem().mesh().refinements;
  if (refinements > 0)
    weak_.softened = std::make_unique<const LineJacobi>(system_, lines_->lines(), Matrices::softened);
  const LineJacobi& lines = weak_.softened ? *weak_.softened : *lines_;
  if (refinements != 1) weak_.K = std::make_unique<const LinePressureStiffness>(system_, lines);
  if (refinements == 0) weak_.parts.push_back(rough_part(system_, lines, *weak_.K, settings_.degree));
  if (refinements > 1) weak_.parts.push_back(fine_patterns_part(system_, *weak_.K, settings_.degree));
  if (refinements > 0)
    weak_.parts.push_back(
        coarse_patterns_part(system_, lines, refinements > 1 ? std::nullopt : settings_.degree));
  if (!weak_.K) weak_.softened.reset();
}

void PressureSchur::apply(std::span<const double> r, std::span<double> z) const {
  std::ranges::transform(diagonal_, r, z.begin(), std::multiplies{});
  if (!strong_) return;
  for (const auto& part : weak_.parts) part->add(r, settings_.weight, z);
}

std::size_t PressureSchur::bytes() const { return bytes_of(diagonal_) + weak_.bytes(); }

std::size_t PressureSchur::Weak::bytes() const {
  std::size_t total = (softened ? softened->bytes() : 0) + (K ? K->bytes() : 0);
  for (const auto& part : parts) total += part->bytes();
  return total;
}

}  // namespace bulbus
