#include "core/material/material.hpp"

namespace bulbus::inline material {

Material make_material(const std::vector<Polynomial::Term>& terms) {
  double c10 = 0, c01 = 0;
  bool linear = true;
  for (const auto& [r, s, c] : terms) {
    if (r == 1 && s == 0)
      c10 += c;
    else if (r == 0 && s == 1)
      c01 += c;
    else if (c != 0 && r + s > 0)
      linear = false;
  }
  if (!linear) return Isotropic<Polynomial>{{terms}};
  if (c01 != 0) return Isotropic<MooneyRivlin>{{c10, c01}};
  return NeoHooke{c10};
}

double initial_shear_modulus(const Material& material) {
  const Sym3<double> identity{{1, 1, 1, 0, 0, 0}};
  return std::visit([&](const auto& m) { return m.shear_modulus(identity); }, material);
}

bool is_polynomial(const Material& material) {
  return std::holds_alternative<NeoHooke>(material) ||
         std::holds_alternative<Isotropic<MooneyRivlin>>(material) ||
         std::holds_alternative<Isotropic<Polynomial>>(material);
}

bool always_stable(const Material& material) {
  return std::holds_alternative<NeoHooke>(material) || std::holds_alternative<Fung>(material) ||
         std::holds_alternative<FibreReinforced>(material);
}

}  // namespace bulbus::inline material
