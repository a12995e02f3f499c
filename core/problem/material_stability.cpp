#include "core/problem/material_stability.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double least_stretch = 0.4, largest_stretch = 3;

struct Mode {
  const char* name;
  std::function<std::array<double, 3>(double)> stretches;
};

const std::array<Mode, 3>& modes() {
  static const std::array<Mode, 3> all{Mode{"uniaxial",
                                            [](double l) {
                                              return std::array{l, 1 / std::sqrt(l), 1 / std::sqrt(l)};
                                            }},
                                       Mode{"equibiaxial",
                                            [](double l) {
                                              return std::array{l, l, 1 / (l * l)};
                                            }},
                                       Mode{"planar", [](double l) {
                                              return std::array{l, 1.0, 1 / l};
                                            }}};
  return all;
}

// From `stable` towards `unstable`, halved until both are one.
double boundary(const Material& material, const Mode& mode, double stable, double unstable) {
  for (int i = 0; i < 40; ++i) {
    const double middle = (stable + unstable) / 2;
    (is_stable(material, mode.stretches(middle)) ? stable : unstable) = middle;
  }
  return stable;
}

std::string words(const StabilityLimit& limit) {
  return fmt::format("{} {} at stretch {:.4g}", limit.mode, limit.stretch > 1 ? "tension" : "compression",
                     limit.stretch);
}

}  // namespace

bool is_stable(const Material& material, const std::array<double, 3>& stretches) {
  if (always_stable(material)) return true;
  constexpr double h = 1e-3;  // of logarithmic stretches: second differences err by h², rounding by 1e-16/h²
  const auto W = [&](double a, double b) {
    const std::array e{std::log(stretches[0]) + a, std::log(stretches[1]) + b,
                       std::log(stretches[2]) - a - b};
    const Sym3<double> left{{std::exp(2 * e[0]), std::exp(2 * e[1]), std::exp(2 * e[2]), 0, 0, 0}};
    return std::visit(
        [&](const auto& m) {
          if constexpr (requires { m.energy(left); })
            return m.energy(left);
          else
            return 0.0;  // fibres: stable without a look
        },
        material);
  };
  const double middle = W(0, 0), aa = (W(h, 0) - 2 * middle + W(-h, 0)) / (h * h),
               bb = (W(0, h) - 2 * middle + W(0, -h)) / (h * h);
  const double ab = (W(h, h) - W(h, -h) - W(-h, h) + W(-h, -h)) / (4 * h * h);
  return aa > 0 && bb > 0 && aa * bb > ab * ab;
}

std::vector<StabilityLimit> stability_limits(const Material& material) {
  constexpr int parts = 200;  // in which the sign is looked for; limits are found more exactly within one
  std::vector<StabilityLimit> limits;
  for (const Mode& mode : modes())
    for (double end : {largest_stretch, least_stretch}) {
      double before = 1;
      for (int i = 1; i <= parts; ++i) {
        const double stretch = std::pow(end, static_cast<double>(i) / parts);
        if (!is_stable(material, mode.stretches(stretch))) {
          limits.push_back({mode.name, boundary(material, mode, before, stretch)});
          break;
        }
        before = stretch;
      }
    }
  return limits;
}

std::vector<std::string> unstable_regions(const Model& model) {
  std::vector<std::string> sentences;
  for (const auto& [name, spec] : model.regions) {
    if (spec.rigid) continue;
    const auto limits = stability_limits(material_of(spec));
    if (limits.empty()) continue;
    std::string list;
    for (const StabilityLimit& limit : limits) list += (list.empty() ? "" : ", ") + words(limit);
    sentences.push_back(fmt::format(
        "the law of region '{}' loses stability (an increment of strain meets no growing stress) in {}: "
        "beyond, results are not to be trusted; choose constants that stay stable, such as none below 0",
        name, list));
  }
  return sentences;
}

}  // namespace bulbus::inline problem
